#include "floc/linalg/symmetric_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace floc {
namespace {

/// Returns the lower triangle of the chain matrix, 2 on the diagonal and -1 beside it. Its eigenvalues are 2 -
/// 2 cos(k pi/(n+1)).
Eigen::SparseMatrix<double> chain(int n) {
  std::vector<Eigen::Triplet<double>> t;
  for (int i = 0; i < n; ++i) {
    t.emplace_back(i, i, 2.0);
    if (i + 1 < n) t.emplace_back(i + 1, i, -1.0);
  }
  Eigen::SparseMatrix<double> m(n, n);
  m.setFromTriplets(t.begin(), t.end());
  return m;
}

/// Returns the chain closed to a ring, whose null space is the constant vector.
Eigen::SparseMatrix<double> ring(int n) {
  Eigen::SparseMatrix<double> m = chain(n);
  m.coeffRef(n - 1, 0) = -1.0;
  return m;
}

TEST(SymmetricFactor, PredictsWhatItsFactorTakes) {
  const int n = 200;
  SymmetricFactor factor;
  factor.set_matrix(Eigen::MatrixXd::Ones(n, n).sparseView());
  const FactorCost dense = factor.predicted_cost();
  EXPECT_GE(dense.bytes, 8.0 * n * (n + 1) / 2);  // the factor is a full triangle
  EXPECT_LE(dense.bytes, 8.0 * n * n);
  EXPECT_NEAR(dense.operations, n * n * n / 3.0, 0.02 * dense.operations);
  factor.set_matrix(chain(n));
  EXPECT_LT(factor.predicted_cost().operations, 10.0 * n);
  ASSERT_TRUE(factor.factorize_positive());  // uses the symbolic analysis of the previous factorization
  EXPECT_EQ(factor.count_eigenvalues_below(1.0), 66);  // the eigenvalues with k pi/201 < pi/3
}

TEST(SymmetricFactor, SolvesWithEitherOrderingAndEitherFactor) {
  const Eigen::MatrixXd X = Eigen::MatrixXd::Random(60, 2);
  for (const Ordering ordering : {Ordering::amd, Ordering::metis}) {
    SymmetricFactor factor(ordering);
    factor.set_matrix(chain(60));
    const Eigen::MatrixXd B = factor.multiply(X);
    ASSERT_TRUE(factor.factorize_positive());
    // The condition number of 1.5e3 amplifies rounding errors.
    EXPECT_LT((factor.solve(B) - X).norm(), 1e-12);
    ASSERT_TRUE(factor.factorize_indefinite());
    EXPECT_LT((factor.solve(B) - X).norm(), 1e-12);
    EXPECT_LT((factor.multiply(factor.solve(B)) - B).norm(), 1e-14);
  }
}

TEST(SymmetricFactor, TakesAnotherMatrixOfTheSamePatternOrOfAnother) {
  const Eigen::MatrixXd X = Eigen::MatrixXd::Random(60, 1);
  SymmetricFactor factor;
  const Eigen::SparseMatrix<double> stiffer = 3.0 * chain(60);
  for (const Eigen::SparseMatrix<double>& matrix : {chain(60), stiffer, ring(60), stiffer}) {
    factor.set_matrix(matrix);
    ASSERT_TRUE(factor.factorize_positive(0.1));
    ASSERT_TRUE(factor.factorize_indefinite(0.1));
    const Eigen::MatrixXd B = factor.multiply(X) + 0.1 * X;
    EXPECT_LT((factor.solve(B, 0) - X).norm(), 1e-13);
  }
}

TEST(SymmetricFactor, OrdersUnknownsByTheirGroups) {
  constexpr int n = 60;
  std::vector<int> group(n);
  for (int u = 0; u < n; ++u) group[u] = u / 3 + (u > 30 ? 2 : 0);  // group numbers may have gaps
  const Eigen::MatrixXd X = Eigen::MatrixXd::Random(n, 1);
  for (const Ordering ordering : {Ordering::amd, Ordering::metis}) {
    SymmetricFactor factor(ordering);
    factor.set_matrix(chain(n), group);
    ASSERT_TRUE(factor.factorize_positive());
    EXPECT_LT((factor.solve(factor.multiply(X)) - X).norm(), 1e-12);
  }
}

TEST(SymmetricFactor, CountsEigenvaluesBelowABound) {
  constexpr int n = 25;
  SymmetricFactor factor;
  factor.set_matrix(chain(n));
  const auto eigenvalue = [](int k) { return 2.0 - 2.0 * std::cos(k * std::numbers::pi / (n + 1)); };
  EXPECT_EQ(factor.count_eigenvalues_below(0.0), 0);
  for (int k = 1; k < n; ++k)
    EXPECT_EQ(factor.count_eigenvalues_below(0.5 * (eigenvalue(k) + eigenvalue(k + 1))), k);
  EXPECT_EQ(factor.count_eigenvalues_below(4.0), n);
}

/// Returns the lower triangle of a band matrix with a few entries far from the diagonal. Its diagonal has
/// random signs.
/// @param positive_share  probability of a positive diagonal entry
Eigen::SparseMatrix<double> any_signs(int n, double positive_share, std::mt19937& engine) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Eigen::Triplet<double>> t;
  for (int c = 0; c < n; ++c) {
    t.emplace_back(c, c, uniform(engine) < 2.0 * positive_share - 1.0 ? 4.0 : -4.0);
    for (int r = c + 1; r < std::min(n, c + 9); ++r) t.emplace_back(r, c, uniform(engine));
    if (const int r = static_cast<int>(engine() % static_cast<unsigned>(n)); r > c)
      t.emplace_back(r, c, uniform(engine));
  }
  Eigen::SparseMatrix<double> m(n, n);
  m.setFromTriplets(t.begin(), t.end());
  return m;
}

TEST(SymmetricFactor, CountsAndSolvesWhateverTheSigns) {
  std::mt19937 engine(1);
  int n_matrices = 0, n_negative = 0;
  for (const int n : {1, 2, 7, 31, 32, 33, 64, 65, 200, 500})
    for (const double positive_share : {0.0, 0.5, 0.9, 1.0})
      for (const int group_size : {1, 3}) {
        const Eigen::SparseMatrix<double> matrix = any_signs(n, positive_share, engine);
        std::vector<int> group(n);
        for (int u = 0; u < n; ++u) group[u] = u / group_size;
        SymmetricFactor factor;
        factor.set_matrix(matrix, group);
        const Eigen::MatrixXd dense = Eigen::MatrixXd(matrix).selfadjointView<Eigen::Lower>();
        const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
        for (const double bound : {-1.0, 0.0, 0.7})
          EXPECT_EQ(factor.count_eigenvalues_below(bound), (values.array() < bound).count())
              << n << " " << bound;
        const Eigen::MatrixXd X = Eigen::MatrixXd::Random(n, 2);
        ASSERT_TRUE(factor.factorize_indefinite(0.3));
        // The factorization does not pivot, so entries of the factor can be large. Large entries amplify rounding
        // errors.
        EXPECT_LT((factor.solve(factor.multiply(X) + 0.3 * X, 0) - X).norm(), 1e-8)
            << n << " " << positive_share;
        EXPECT_EQ(factor.factorize_positive(), (values.array() > 0.0).all());
        ++n_matrices;
        n_negative += static_cast<int>((values.array() < 0.0).count());
      }
  std::cout << n_matrices << " matrices, " << n_negative << " negative eigenvalues\n";
  EXPECT_GT(n_negative, 1000);
}

TEST(SymmetricFactor, AMatrixThatIsNotFiniteHasNoFactor) {
  Eigen::SparseMatrix<double> matrix = chain(40);
  matrix.coeffRef(20, 20) = std::numeric_limits<double>::quiet_NaN();
  SymmetricFactor factor;
  factor.set_matrix(matrix);
  EXPECT_FALSE(factor.factorize_indefinite());
  EXPECT_THROW(factor.count_eigenvalues_below(0.0), std::runtime_error);
}

TEST(SymmetricFactor, AnswersThatAMatrixIsNotPositiveDefinite) {
  SymmetricFactor factor;
  factor.set_matrix(chain(10));
  EXPECT_FALSE(factor.factorize_positive(-1.0));
  EXPECT_TRUE(factor.factorize_positive());
  Eigen::SparseMatrix<double> negative = -chain(10);
  factor.set_matrix(negative);
  EXPECT_FALSE(factor.factorize_positive());
  EXPECT_TRUE(factor.factorize_indefinite());
}

TEST(SymmetricFactor, ASmallShiftSolvesASingularSystemOnItsRange) {
  SymmetricFactor factor;
  factor.set_matrix(ring(30));
  Eigen::MatrixXd X = Eigen::MatrixXd::Random(30, 1);
  X.array() -= X.mean();
  const Eigen::MatrixXd B = factor.multiply(X);
  ASSERT_TRUE(factor.factorize_positive(1e-10));
  Eigen::MatrixXd found = factor.solve(B, 20);
  found.array() -= found.mean();
  // With the shift of 1e-10, rounding adds about 1e-16/1e-10 times the null vector to the solution. Subtracting
  // the mean removes this error.
  EXPECT_LT((found - X).norm(), 1e-9);
  EXPECT_LT((factor.multiply(found) - B).norm(), 1e-12);
  EXPECT_EQ(factor.count_eigenvalues_below(1e-12), 1);
  EXPECT_EQ(factor.count_eigenvalues_below(-1e-12), 0);
}

TEST(SymmetricFactor, EstimatesTheConditionNumber) {
  SymmetricFactor factor;
  factor.set_matrix(chain(40));
  ASSERT_TRUE(factor.factorize_positive());
  const Eigen::MatrixXd dense = Eigen::MatrixXd(chain(40)).selfadjointView<Eigen::Lower>();
  const double exact =
      dense.cwiseAbs().colwise().sum().maxCoeff() * dense.inverse().cwiseAbs().colwise().sum().maxCoeff();
  EXPECT_LE(factor.condition_estimate(), exact * (1.0 + 1e-12));
  EXPECT_GT(factor.condition_estimate(), exact / 3.0);
}

TEST(SymmetricFactor, TakesAnEmptyMatrix) {
  SymmetricFactor factor;
  factor.set_matrix(Eigen::SparseMatrix<double>(0, 0));
  EXPECT_TRUE(factor.factorize_positive());
  EXPECT_EQ(factor.solve(Eigen::MatrixXd(0, 2)).cols(), 2);
  EXPECT_EQ(factor.count_eigenvalues_below(1.0), 0);
  EXPECT_EQ(factor.condition_estimate(), 1.0);
}

}  // namespace
}  // namespace floc
