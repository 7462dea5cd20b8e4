#include "floc/linalg/single_factor.h"

#include <gtest/gtest.h>

namespace floc {
namespace {

/// Returns the stiffness matrix of a chain of n masses, with unit springs between neighbours and springs of
/// stiffness `ground` to the ground.
Eigen::SparseMatrix<double> chain(int n, double ground) {
  Eigen::SparseMatrix<double> lower(n, n);
  for (int k = 0; k < n; ++k) {
    lower.insert(k, k) = 2.0 + ground;
    if (k + 1 < n) lower.insert(k + 1, k) = -1.0;
  }
  return lower;
}

TEST(SingleFactor, SolvesToTheDigitsOfSinglePrecision) {
  const Eigen::SparseMatrix<double> a = chain(50, 1.0);
  const SingleFactor factor(a);
  ASSERT_TRUE(factor.positive());
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(50, -1.0, 1.0);
  const Eigen::VectorXd b = a.selfadjointView<Eigen::Lower>() * x;
  // The condition number is 5, and the rounding unit of single precision is 6e-8. The shift is 1e-6 times the smallest
  // eigenvalue, which is 1.
  EXPECT_LT((factor.solve(b) - x).lpNorm<Eigen::Infinity>(), 5e-6);
}

TEST(SingleFactor, DoesNotLoseForcesBelowTheRangeOfSinglePrecision) {
  const SingleFactor factor(chain(3, 1.0));
  const Eigen::VectorXd b = Eigen::Vector3d(1.0, -2.0, 0.5);
  const Eigen::VectorXd small = factor.solve(1e-200 * b);
  EXPECT_LT((1e200 * small - factor.solve(b)).norm(), 1e-6);
  EXPECT_EQ(factor.solve(Eigen::VectorXd::Zero(3)).norm(), 0.0);
}

TEST(SingleFactor, ShiftsWhatRoundingMakesIndefiniteAndSaysSo) {
  // Both ends of the chain are free, so a translation needs no energy. The pivot of the translation is zero except for
  // rounding errors, which decide its sign.
  Eigen::SparseMatrix<double> free = chain(50, 0.0);
  free.coeffRef(0, 0) = free.coeffRef(49, 49) = 1.0;
  const SingleFactor factor(free);
  EXPECT_TRUE(factor.positive());
  EXPECT_GT(factor.shift(), 0.0);
}

TEST(SingleFactor, RefusesAnIndefiniteMatrix) {
  Eigen::SparseMatrix<double> a = chain(5, 1.0);
  a.coeffRef(2, 2) = -3.0;
  EXPECT_FALSE(SingleFactor(a).positive());
}

TEST(SingleFactor, OfNothingSolvesNothing) {
  const SingleFactor factor(Eigen::SparseMatrix<double>(0, 0));
  EXPECT_TRUE(factor.positive());
  EXPECT_EQ(factor.solve(Eigen::VectorXd()).size(), 0);
}

}  // namespace
}  // namespace floc
