#include "floc/base/lanes.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "floc/base/vec.h"

namespace floc {
namespace {

TEST(Lanes, ClampKeepsTheSignAndLimitsTheMagnitude) {
  EXPECT_EQ(lanes::clamp_magnitude(0.3, 0.5), 0.3);
  EXPECT_EQ(lanes::clamp_magnitude(0.7, 0.5), 0.5);
  EXPECT_EQ(lanes::clamp_magnitude(-0.7, 0.5), -0.5);
  EXPECT_EQ(lanes::clamp_magnitude(-0.7, 0.0), 0.0);
}

TEST(Lanes, SelectCarriesTheDerivativeOfTheChosenSide) {
  using Dual = ceres::Jet<double, 1>;
  const Dual x(2.0, 0);
  EXPECT_EQ(lanes::min(x, Dual(5.0)).v[0], 1.0);
  EXPECT_EQ(lanes::max(x, Dual(5.0)).v[0], 0.0);
  EXPECT_EQ(lanes::select(x < Dual(3.0), Dual(3.0 * x), x).v[0], 3.0);
}

TEST(Vec, AGrainHasThreeFreedomsIn2DAndSixIn3D) {
  EXPECT_EQ(kDofs<2>, 3);
  EXPECT_EQ(kDofs<3>, 6);
  EXPECT_EQ(kSymmetric<2>, 3);
  EXPECT_EQ(kSymmetric<3>, 6);
}

}  // namespace
}  // namespace floc
