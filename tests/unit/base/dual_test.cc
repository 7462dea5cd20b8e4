#include "floc/base/dual.h"

#include <gtest/gtest.h>

#include "floc/base/lanes.h"

namespace floc {
namespace {

using Number = Dual<2>;

/// Formula that uses every operation of dual numbers.
template <class T>
T formula(const T& x, const T& y) {
  using std::cos, std::exp, std::log, std::pow, std::sin, std::sqrt;
  return sqrt(x * x + 2.0 * y) / (1.0 + x) - sin(x) * cos(y) + exp(-y) * log(x) + pow(x, 1.5) - (-y);
}

TEST(Dual, CarriesTheDerivativesOfAFormula) {
  const double x = 1.3, y = 0.4, step = 1e-6;
  const Number f = formula(Number(x, 0), Number(y, 1));
  EXPECT_EQ(f.value, formula(x, y));
  // The truncation error of the differences is about step^2, their rounding error 1e-16/step.
  EXPECT_NEAR(f.derivative[0], (formula(x + step, y) - formula(x - step, y)) / (2.0 * step), 1e-9);
  EXPECT_NEAR(f.derivative[1], (formula(x, y + step) - formula(x, y - step)) / (2.0 * step), 1e-9);
}

TEST(Dual, TakesTheBranchOfItsValue) {
  const Number x(2.0, 0);
  EXPECT_EQ(lanes::min(x, Number(5.0)).derivative[0], 1.0);
  EXPECT_EQ(lanes::max(x, Number(5.0)).derivative[0], 0.0);
  EXPECT_EQ(lanes::clamp_magnitude(Number(-2.0, 0), Number(1.0, 1)).derivative[1], -1.0);
}

TEST(Dual, IsAnElementOfEigensVectors) {
  Eigen::Matrix<Number, 2, 1> v(Number(3.0, 0), Number(4.0, 1));
  EXPECT_EQ(v.squaredNorm().derivative[1], 8.0);
  EXPECT_EQ(v.norm().value, 5.0);
  EXPECT_EQ((v * Number(2.0)).sum().derivative[0], 2.0);
}

}  // namespace
}  // namespace floc
