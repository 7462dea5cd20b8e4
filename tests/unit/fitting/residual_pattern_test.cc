#include "floc/fitting/residual_pattern.h"

#include <gtest/gtest.h>

#include <cmath>

#include "floc/base/random.h"
#include "floc/fitting/incomplete_beta.h"
#include "floc/fitting/least_squares.h"

namespace floc {
namespace {

TEST(IncompleteBeta, HasItsClosedForms) {
  for (const double x : {0.0, 0.05, 0.3, 0.5, 0.8, 0.99, 1.0}) {
    EXPECT_NEAR(incomplete_beta(1.0, 1.0, x), x, 1e-12);
    EXPECT_NEAR(incomplete_beta(3.0, 1.0, x), x * x * x, 1e-12);
    EXPECT_NEAR(incomplete_beta(1.0, 4.0, x), 1.0 - std::pow(1.0 - x, 4), 1e-12);
    EXPECT_NEAR(incomplete_beta(0.5, 0.5, x), 2.0 / M_PI * std::asin(std::sqrt(x)), 1e-12);
    EXPECT_NEAR(incomplete_beta(40.0, 60.0, x) + incomplete_beta(60.0, 40.0, 1.0 - x), 1.0, 1e-12);
  }
}

/// Returns the residuals of y from its best straight line.
/// @param basis  basis of the straight lines
Eigen::VectorXd of_line(const Eigen::VectorXd& y, const Eigen::MatrixXd& basis) {
  return y - basis * (basis.transpose() * y);
}

Eigen::MatrixXd basis_of_lines(Eigen::Index n) {
  Eigen::MatrixXd columns(n, 2);
  columns.col(0).setOnes();
  columns.col(1).setLinSpaced(n, 0.0, 1.0);
  return basis_of(columns);
}

TEST(ResidualPattern, IndependentResidualsAreSystematicInOneOfAHundred) {
  constexpr int kDraws = 4000;
  for (const Eigen::Index n : {8, 15, 40}) {
    const Eigen::MatrixXd basis = basis_of_lines(n);
    RandomStream random(7, 0);
    int systematic = 0, low = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const Eigen::VectorXd noise = Eigen::VectorXd::NullaryExpr(n, [&] { return random.normal(); });
      const ResidualPattern pattern = residual_pattern(of_line(noise, basis), basis);
      systematic += pattern.is_systematic();
      low += pattern.smoothness_p < 0.1;
    }
    EXPECT_LE(systematic, 0.013 * kDraws) << n;
    // For random residuals, the p-value smoothness_p is uniformly distributed, so 10 % of the draws give a value below
    // 0.1. Four standard deviations of this fraction are 0.019.
    EXPECT_NEAR(low / static_cast<double>(kDraws), 0.1, 0.019) << n;
  }
}

TEST(ResidualPattern, AParabolaUnderAStraightLineIsSystematic) {
  constexpr Eigen::Index kPoints = 20;
  const Eigen::MatrixXd basis = basis_of_lines(kPoints);
  RandomStream random(3, 0);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(kPoints, -1.0, 1.0);
  const Eigen::VectorXd y =
      x.cwiseProduct(x) + Eigen::VectorXd::NullaryExpr(kPoints, [&] { return 0.05 * random.normal(); });
  const ResidualPattern pattern = residual_pattern(of_line(y, basis), basis);
  EXPECT_TRUE(pattern.is_systematic());
  EXPECT_GT(pattern.variance_factor(), 3.0);
}

TEST(ResidualPattern, RoundingHasNone) {
  const Eigen::MatrixXd basis = basis_of_lines(10);
  EXPECT_FALSE(residual_pattern(Eigen::VectorXd::Constant(10, 1e-12), basis).is_systematic());
}

}  // namespace
}  // namespace floc
