#include "floc/linalg/unsymmetric_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "floc/linalg/blas.h"

namespace floc {
namespace {

Eigen::SparseMatrix<double> cyclic(int n, double diagonal, double above) {
  std::vector<Eigen::Triplet<double>> t;
  for (int i = 0; i < n; ++i) {
    t.emplace_back(i, i, diagonal);
    t.emplace_back(i, (i + 1) % n, above);
  }
  Eigen::SparseMatrix<double> m(n, n);
  m.setFromTriplets(t.begin(), t.end());
  return m;
}

TEST(UnsymmetricFactor, SolvesToRounding) {
  const auto m = cyclic(20, 3.0, -1.0);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(20, -1.0, 2.0);
  UnsymmetricFactor factor;
  ASSERT_TRUE(factor.factorize(m));
  // The condition number is below 2, so only a wrong solver has errors above a few rounding units.
  EXPECT_LT((factor.solve(m * x) - x).norm(), 1e-14);
}

TEST(UnsymmetricFactor, FollowsNewValuesOnTheOldPatternAndOnANewOne) {
  UnsymmetricFactor factor;
  for (const auto& m :
       {cyclic(20, 3.0, -1.0), cyclic(20, -2.0, 0.5), cyclic(7, 4.0, 1.0), cyclic(20, 0.0, 1.0)}) {
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(m.cols(), 1.0, 2.0);
    ASSERT_TRUE(factor.factorize(m));
    EXPECT_LT((factor.solve(m * x) - x).norm(), 1e-14);
  }
}

TEST(UnsymmetricFactor, SaysSingularAndRecovers) {
  UnsymmetricFactor factor;
  EXPECT_FALSE(factor.factorize(cyclic(4, 1.0, -1.0)));
  EXPECT_EQ(factor.reciprocal_condition(), 0.0);
  EXPECT_TRUE(factor.factorize(cyclic(4, 2.0, -1.0)));
  EXPECT_GT(factor.reciprocal_condition(), 0.0);
  EXPECT_FALSE(factor.factorize(cyclic(4, std::numeric_limits<double>::quiet_NaN(), -1.0)));
}

TEST(Blas, IsOpenBlas) {
  EXPECT_NE(blas_library().find("openblas"), std::string::npos) << blas_library();
}

}  // namespace
}  // namespace floc
