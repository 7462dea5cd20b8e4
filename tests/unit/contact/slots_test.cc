#include <gtest/gtest.h>

#include "floc/base/vec.h"
#include "floc/contact/adhesion/constant_adhesion.h"
#include "floc/contact/adhesion/tail_adhesion.h"
#include "floc/contact/capped_spring.h"
#include "floc/contact/normal/linear_repulsion.h"
#include "floc/contact/rolling/rolling_spring.h"
#include "floc/contact/tangential/coulomb_friction.h"

namespace floc {
namespace {

TEST(LinearRepulsion, IsKNTimesTheOverlap) {
  const LinearRepulsion repulsion{200.0};
  EXPECT_DOUBLE_EQ(repulsion.force(PairGeometry<>(-0.25)), 50.0);
  EXPECT_EQ(repulsion.force(PairGeometry<>(0.25)), 0.0);
}

TEST(TailAdhesion, FallsLinearlyFromF0ToZeroOverItsRange) {
  const TailAdhesion tail{8.0, 0.5};
  EXPECT_EQ(tail.force(PairGeometry<>(-0.1)), -8.0);
  EXPECT_EQ(tail.force(PairGeometry<>(0.0)), -8.0);
  EXPECT_DOUBLE_EQ(tail.force(PairGeometry<>(0.125)), -6.0);
  EXPECT_DOUBLE_EQ(tail.force(PairGeometry<>(0.25)), -4.0);
  EXPECT_EQ(tail.force(PairGeometry<>(0.5)), 0.0);
  EXPECT_EQ(tail.force(PairGeometry<>(0.7)), 0.0);
  EXPECT_EQ(tail.stiffness(PairGeometry<>(0.25)), -16.0);
  EXPECT_EQ(tail.energy(PairGeometry<>(0.0)), -2.0);
  EXPECT_DOUBLE_EQ(tail.energy(PairGeometry<>(0.25)), -0.5);
}

TEST(ConstantAdhesion, ActsInContactOnly) {
  const ConstantAdhesion constant{8.0};
  EXPECT_EQ(constant.force(PairGeometry<>(-1e-12)), -8.0);
  EXPECT_EQ(constant.force(PairGeometry<>(0.0)), 0.0);
  EXPECT_EQ(constant.range(), 0.0);
}

TEST(CoulombFriction, LongestSpringTimesStiffnessIsTheCap) {
  const CoulombFriction friction{0.5, 40.0};
  double spring = 0.0;
  EXPECT_DOUBLE_EQ(friction.respond(PairGeometry<>(-0.1), NormalResponse<double>{6.0, 0.0, 1.0, 1.0},
                                    Vec<1>(9.0), &spring)[0],
                   3.0);
  EXPECT_DOUBLE_EQ(40.0 * spring, 3.0);
  EXPECT_TRUE(friction.is_mobilised<Vec<1>>(6.0, &spring, 0.0));
  EXPECT_FALSE(friction.is_mobilised<Vec<1>>(6.1, &spring, 0.0));
  EXPECT_EQ(friction.respond(PairGeometry<>(0.1), NormalResponse<double>{0.0, 0.0, 0.0, 0.0}, Vec<1>(9.0),
                             &spring)[0],
            0.0);
}

TEST(RollingSpring, LargestTurnTimesStiffnessIsTheCap) {
  const RollingSpring rolling{0.05, 10.0};
  double spring = 0.0;
  EXPECT_DOUBLE_EQ(rolling.respond(PairGeometry<>(-0.1), NormalResponse<double>{6.0, 0.0, 1.0, 1.0},
                                   Vec<1>(-9.0), &spring)[0],
                   -0.3);
}

TEST(CappedSpring, OfOneComponentIsClamped) {
  EXPECT_EQ(capped(Vec<1>(0.2), 0.5)[0], 0.2);
  EXPECT_EQ(capped(Vec<1>(-2.0), 0.5)[0], -0.5);
  EXPECT_EQ(capped(Vec<1>(-2.0), 0.0)[0], 0.0);
}

TEST(CappedSpring, OfSeveralComponentsIsShortenedInItsDirection) {
  EXPECT_EQ(capped(Vec<3>(0.3, 0.0, 0.4), 0.6), Vec<3>(0.3, 0.0, 0.4));
  EXPECT_NEAR((capped(Vec<3>(3.0, 0.0, -4.0), 0.5) - Vec<3>(0.3, 0.0, -0.4)).norm(), 0.0, 1e-16);
  EXPECT_EQ(capped(Vec<3>(3.0, 0.0, -4.0), 0.0).norm(), 0.0);
  EXPECT_EQ(capped(Vec<3>(0.0, 0.0, 0.0), 0.0).norm(), 0.0);
}

}  // namespace
}  // namespace floc
