#include "floc/linalg/positivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace floc {
namespace {

/// Tests whether the matrix of a chain is positive. The matrix has 2 + shift on the diagonal and -1 beside it. Its
/// lowest eigenvalue, 2 - 2 cos(pi/(n+1)) + shift, is about 1e-5 + shift for 1000 unknowns.
Positivity test_chain(int n, double shift, const PositivityOptions& options) {
  const auto apply = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd y = (2.0 + shift) * x;
    y.head(n - 1) -= x.tail(n - 1);
    y.tail(n - 1) -= x.head(n - 1);
    return y;
  };
  return test_positivity(n, apply, options);
}

double lowest_of_chain(int n) {
  return 2.0 - 2.0 * std::cos(std::numbers::pi / (n + 1));
}

TEST(Positivity, OfAPositiveMatrixIsKnownToTheBoundAskedFor) {
  PositivityOptions options;
  options.bound = 1e-5;
  constexpr int kOrder = 20000;
  const Positivity found = test_chain(kOrder, 0.0, options);
  EXPECT_FALSE(found.negative);
  EXPECT_LE(found.bound, options.bound);
  EXPECT_GT(found.bound, 0.99 * options.bound);
  // By Gershgorin circles, all eigenvalues lie in a range of at most 4.
  EXPECT_NEAR(found.steps, predicted_steps(kOrder, 4.0, options), 0.1 * found.steps);
}

TEST(Positivity, IsKnownToRoundingWhereNothingIsLeftToLookFor) {
  const Positivity found = test_chain(50, 0.0, {});
  EXPECT_FALSE(found.negative);
  EXPECT_LE(found.steps, 60);
  EXPECT_EQ(found.bound, PositivityOptions{}.rounding);
}

TEST(Positivity, FindsWhateverLiesBelowItsBound) {
  PositivityOptions options;
  for (const double bound : {1e-2, 1e-3, 1e-4, 1e-5}) {
    options.bound = bound;
    const Positivity found = test_chain(1000, -lowest_of_chain(1000) - bound, options);
    EXPECT_TRUE(found.negative) << bound;
    EXPECT_LE(found.steps, predicted_steps(1000, 4.0, options));
  }
}

TEST(Positivity, TakesAVanishingEigenvalueForNone) {
  PositivityOptions options;
  options.bound = 1e-5;
  EXPECT_FALSE(test_chain(100, -lowest_of_chain(100), options).negative);
}

TEST(Positivity, SaysHowFarItCameWhereStepsWereTooFew) {
  PositivityOptions options;
  options.bound = 1e-8;
  options.max_steps = 50;
  const Positivity found = test_chain(1000, 0.0, options);
  EXPECT_EQ(found.steps, 50);
  EXPECT_FALSE(found.negative);
  EXPECT_GT(found.bound, options.bound);
}

TEST(Positivity, OfNothingIsGiven) {
  EXPECT_FALSE(test_positivity(0, [](const Eigen::VectorXd& x) { return x; }, {}).negative);
}

}  // namespace
}  // namespace floc
