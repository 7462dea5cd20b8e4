#include "floc/linalg/least_squares_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace floc {
namespace {

TEST(LeastSquaresFactor, SolvesWithTheSquareOfItsMatrix) {
  std::srand(1);
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(20, 12);
  const LeastSquaresFactor factor(a.sparseView(), 1e-12);
  EXPECT_EQ(factor.rank(), 12);
  const Eigen::VectorXd x = Eigen::VectorXd::Random(12);
  // Rounding errors are multiplied by the square of the condition number of a. The condition number is about
  // 10.
  EXPECT_LT((factor.solve(a.transpose() * (a * x)) - x).norm(), 1e-12);
}

/// The columns have lengths from 1 to 1e-12, so a^T a is singular in working precision.
TEST(LeastSquaresFactor, KeepsTheDigitsThatTheSquareLoses) {
  std::srand(2);
  Eigen::MatrixXd a = Eigen::MatrixXd::Random(20, 8);
  Eigen::VectorXd length(8);
  for (int c = 0; c < 8; ++c) length[c] = std::pow(10.0, -12.0 * c / 7.0);
  const Eigen::VectorXd x = Eigen::VectorXd::Random(8);
  const Eigen::MatrixXd square = a.transpose() * a;
  const Eigen::MatrixXd scaled = a * length.asDiagonal();
  const LeastSquaresFactor factor(scaled.sparseView(), 1e-15);
  EXPECT_EQ(factor.rank(), 8);
  const Eigen::VectorXd b = length.asDiagonal() * (square * x);
  const Eigen::VectorXd found = length.asDiagonal() * factor.solve(b);
  EXPECT_LT((found - x).norm(), 1e-12);
}

TEST(LeastSquaresFactor, LeavesDependentColumnsOut) {
  std::srand(3);
  Eigen::MatrixXd a = Eigen::MatrixXd::Random(20, 6);
  a.col(4) = a.col(0) - 2.0 * a.col(1);
  const LeastSquaresFactor factor(a.sparseView(), 1e-13);
  EXPECT_EQ(factor.rank(), 5);
  // If the right-hand side is in the range of a^T a, the solution is exact, although one column was left out.
  const Eigen::VectorXd b = a.transpose() * Eigen::VectorXd::Random(20);
  EXPECT_LT((a.transpose() * (a * factor.solve(b)) - b).norm(), 1e-12);
}

TEST(LeastSquaresFactor, TakesFewerRowsThanColumns) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Ones(1, 2);
  const LeastSquaresFactor factor(a.sparseView(), 1e-13);
  EXPECT_EQ(factor.rank(), 1);
  EXPECT_NEAR(factor.solve(Eigen::VectorXd::Ones(2)).sum(), 1.0, 1e-15);
}

}  // namespace
}  // namespace floc
