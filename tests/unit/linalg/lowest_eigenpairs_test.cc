#include "floc/linalg/lowest_eigenpairs.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace floc {
namespace {

/// Returns the lower triangle of `copies` rings of n masses and unit springs. Their eigenvalues are 2 - 2 cos(2
/// pi k/n); in each ring all except the smallest and the largest are double.
Eigen::SparseMatrix<double> rings(int n, int copies) {
  std::vector<Eigen::Triplet<double>> t;
  for (int r = 0; r < copies; ++r)
    for (int i = 0; i < n; ++i) {
      t.emplace_back(n * r + i, n * r + i, 2.0);
      if (i + 1 < n) t.emplace_back(n * r + i + 1, n * r + i, -1.0);
      if (i + 1 == n) t.emplace_back(n * r + i, n * r, -1.0);
    }
  Eigen::SparseMatrix<double> m(n * copies, n * copies);
  m.setFromTriplets(t.begin(), t.end());
  return m;
}

double eigenvalue(int k, int n) {
  return 2.0 - 2.0 * std::cos(2.0 * std::numbers::pi * k / n);
}

/// Returns the constant vector of each ring, as columns.
Eigen::SparseMatrix<double> constants(int n, int copies) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n * copies, copies);
  for (int r = 0; r < copies; ++r) m.col(r).segment(n * r, n).setOnes();
  return m.sparseView();
}

void expect_eigenpairs(const SymmetricFactor& factor, const Eigenpairs& pairs) {
  const Eigen::MatrixXd residual =
      factor.multiply(pairs.vectors) - pairs.vectors * pairs.values.asDiagonal().toDenseMatrix();
  // The residual of an eigenvector is of the order of the square root of the tolerance for eigenvalues.
  EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-7);
  const Eigen::Index k = pairs.vectors.cols();
  EXPECT_LT((pairs.vectors.transpose() * pairs.vectors - Eigen::MatrixXd::Identity(k, k)).norm(), 1e-12);
}

/// Hundreds of eigenvalues are zero here. A Lanczos iteration would find only one vector of a multiple eigenvalue; a
/// block iteration finds all vectors together.
TEST(LowestEigenpairs, OfHundredsOfMechanismsAreFoundAtOnce) {
  constexpr int kCopies = 300;
  const Eigen::SparseMatrix<double> nothing(10 * kCopies, 0);
  SymmetricFactor factor;
  factor.set_matrix(rings(10, kCopies));
  const Eigenpairs some = lowest_eigenpairs(factor, nothing, 100);
  ASSERT_EQ(some.values.size(), 100);
  EXPECT_TRUE(some.complete);
  expect_eigenpairs(factor, some);
  EXPECT_LT(some.values.cwiseAbs().maxCoeff(), 1e-14);
  // This matrix has only five zero eigenvalues, so that other eigenvalues follow.
  SymmetricFactor few;
  few.set_matrix(rings(100, 5));
  const Eigenpairs all = lowest_eigenpairs(few, Eigen::SparseMatrix<double>(500, 0), 12);
  EXPECT_TRUE(all.complete);
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(all.values[k], k < 5 ? 0.0 : eigenvalue(1, 100), 1e-14) << k;
}

TEST(LowestEigenpairs, OfRingsLackNoCopyOfAMultipleOne) {
  for (const auto& [n, copies] : {std::pair{300, 1}, {100, 4}, {60, 9}}) {
    SymmetricFactor factor;
    factor.set_matrix(rings(n, copies));
    const Eigen::SparseMatrix<double> null_space = constants(n, copies);
    const Eigenpairs pairs = lowest_eigenpairs(factor, null_space, 20);
    ASSERT_EQ(pairs.values.size(), 20);
    EXPECT_TRUE(pairs.complete);
    expect_eigenpairs(factor, pairs);
    for (int k = 0; k < 20; ++k)
      EXPECT_NEAR(pairs.values[k], eigenvalue(1 + k / (2 * copies), n), 1e-14) << n << ' ' << k;
    EXPECT_LT((null_space.transpose() * pairs.vectors).cwiseAbs().maxCoeff(), 1e-11);
  }
}

TEST(LowestEigenpairs, IncludeZeroAndNegativeOnes) {
  constexpr int n = 200;
  Eigen::SparseMatrix<double> matrix = rings(n, 1);
  SymmetricFactor factor;
  factor.set_matrix(matrix);
  const Eigen::SparseMatrix<double> nothing(n, 0);
  EXPECT_NEAR(lowest_eigenpairs(factor, nothing, 3).values[0], 0.0, 1e-14);
  const double shift = 0.5 * (eigenvalue(2, n) + eigenvalue(3, n));
  for (int i = 0; i < n; ++i) matrix.coeffRef(i, i) -= shift;
  factor.set_matrix(matrix);
  const Eigenpairs pairs = lowest_eigenpairs(factor, nothing, 7);
  EXPECT_TRUE(pairs.complete);
  for (int k = 0; k < 7; ++k) EXPECT_NEAR(pairs.values[k], eigenvalue((k + 1) / 2, n) - shift, 1e-13);
}

TEST(LowestEigenpairs, OfASmallMatrixAreAllThereAre) {
  SymmetricFactor factor;
  factor.set_matrix(rings(5, 2));
  const Eigenpairs pairs = lowest_eigenpairs(factor, constants(5, 2), 50);
  ASSERT_EQ(pairs.values.size(), 8);
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(pairs.values[k], eigenvalue(1 + k / 4, 5), 1e-14);
  expect_eigenpairs(factor, pairs);
}

}  // namespace
}  // namespace floc
