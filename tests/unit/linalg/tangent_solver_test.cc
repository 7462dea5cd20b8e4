#include "floc/linalg/tangent_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <random>
#include <vector>

namespace floc {
namespace {

constexpr TangentLayout kLayout{3, 2};

/// Returns the matrix of a ring of grains with three unknowns each. The unknowns are coupled to those of the neighbours
/// and to two unknowns of a boundary.
/// @param skew      size of the antisymmetric part
/// @param diagonal  stiffness that holds each unknown in place
Eigen::SparseMatrix<double> ring_of_grains(int n_grains, double skew, double diagonal) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  const int n = 3 * n_grains;
  const auto add = [&](int row, int column, double size) {
    const double value = size * any(engine), odd = skew * size * any(engine);
    entries.emplace_back(row, column, value + odd);
    entries.emplace_back(column, row, value - odd);
  };
  for (int i = 0; i < n_grains; ++i)
    for (int a = 0; a < 3; ++a) {
      entries.emplace_back(3 * i + a, 3 * i + a, diagonal);
      for (int b = 0; b < 3; ++b) add(3 * i + a, 3 * ((i + 1) % n_grains) + b, 0.1);
      for (int b = 0; b < 2; ++b) add(3 * i + a, n + b, 0.1);
    }
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) entries.emplace_back(n + a, n + b, a == b ? n_grains : 0.0);
  Eigen::SparseMatrix<double> matrix(n + 2, n + 2);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(TangentSolver, SolvesByEachMethod) {
  const Eigen::SparseMatrix<double> matrix = 1e7 * ring_of_grains(40, 0.3, 1.0);
  const Eigen::VectorXd expected = Eigen::VectorXd::Random(matrix.rows());
  for (const TangentMethod method : {TangentMethod::lu, TangentMethod::cholesky, TangentMethod::diagonal}) {
    TangentSolver solver({method, 0.0, false}, kLayout);
    ASSERT_TRUE(solver.set_matrix(matrix));
    const auto x = solver.solve(matrix * expected);
    ASSERT_TRUE(x.has_value());
    EXPECT_LT((*x - expected).norm(), 1e-6 * expected.norm()) << static_cast<int>(method);
  }
}

/// The solver can use the factorization of the first matrix for the second matrix too. The third matrix has scaled rows
/// and columns and needs a factorization of its own.
TEST(TangentSolver, KeepsAFactorWhileItServes) {
  TangentSolver solver({TangentMethod::cholesky, 0.0, false}, kLayout);
  const Eigen::SparseMatrix<double> first = ring_of_grains(400, 0.3, 1.0);
  const Eigen::VectorXd scale = (2.0 * Eigen::VectorXd::Random(first.rows())).array().exp();
  const Eigen::SparseMatrix<double> third = scale.asDiagonal() * first * scale.asDiagonal();
  for (const Eigen::SparseMatrix<double>& matrix : {first, Eigen::SparseMatrix<double>(1.2 * first), third}) {
    const Eigen::VectorXd expected = Eigen::VectorXd::Random(matrix.rows());
    ASSERT_TRUE(solver.set_matrix(matrix));
    const auto x = solver.solve(matrix * expected);
    ASSERT_TRUE(x.has_value());
    EXPECT_LT((matrix * (*x - expected)).norm(), 2e-8 * (matrix * expected).norm());
  }
}

TEST(TangentSolver, SaysThatItHasNoSolution) {
  Eigen::SparseMatrix<double> matrix = ring_of_grains(10, 0.0, 1.0);
  matrix.coeffRef(4, 4) = std::numeric_limits<double>::quiet_NaN();
  for (const TangentMethod method : {TangentMethod::lu, TangentMethod::cholesky, TangentMethod::diagonal})
    EXPECT_FALSE(TangentSolver({method}, kLayout).set_matrix(matrix));
}

/// The antisymmetric part of the matrix is so large that the iteration, which uses a factorization of the symmetric
/// part, does not converge.
TEST(TangentSolver, TakesAFactorWhereTheIterationDoesNotConverge) {
  const Eigen::SparseMatrix<double> matrix = ring_of_grains(400, 1e3, 1.0);
  const Eigen::VectorXd expected = Eigen::VectorXd::Random(matrix.rows());
  for (const bool lu_at_need : {false, true}) {
    TangentSolver solver({TangentMethod::cholesky, 0.0, lu_at_need}, kLayout);
    for (int k = 0; k < 2; ++k) {
      ASSERT_TRUE(solver.set_matrix(matrix));
      const auto x = solver.solve(matrix * expected);
      ASSERT_EQ(x.has_value(), lu_at_need);
      if (x) {
        EXPECT_LT((*x - expected).norm(), 1e-6 * expected.norm());
      }
    }
  }
}

/// The matrix of a ring has a factorization with very few non-zero entries.
TEST(TangentSolver, PlansAFactorWhereItIsCheap) {
  EXPECT_EQ(plan_tangent(ring_of_grains(300, 0.3, 1.0), kLayout).method, TangentMethod::lu);
  const auto seconds = [](int n) { return plan_tangent(ring_of_grains(n, 0.3, 1.0), kLayout).seconds; };
  EXPECT_NEAR(seconds(2000) / seconds(1000), 2.0, 0.2);
}

}  // namespace
}  // namespace floc
