#include "floc/linalg/condensation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace floc {
namespace {

using Exact = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// Returns a system of random springs; there should be more springs than unknowns.
SpringSystem random_springs(int n_springs, int n_free, int n_boundary, double smallest_stiffness) {
  SpringSystem s;
  s.on_free = Eigen::MatrixXd(Eigen::MatrixXd::Random(n_springs, n_free)).sparseView();
  s.on_boundary = Eigen::MatrixXd::Random(n_springs, n_boundary);
  s.stiffness = Eigen::VectorXd::Random(n_springs).cwiseAbs().array() + smallest_stiffness;
  return s;
}

Eigen::MatrixXd stiffness_of(const SpringSystem& s) {
  const Eigen::MatrixXd a = s.on_free;
  return a.transpose() * s.stiffness.asDiagonal() * a;
}

/// Returns the Schur complement, computed in extended precision.
Eigen::MatrixXd exact(const SpringSystem& s) {
  const Exact a = Eigen::MatrixXd(s.on_free).cast<long double>();
  const Exact b = s.on_boundary.cast<long double>();
  const Exact k = s.stiffness.cast<long double>().asDiagonal();
  const Exact u = (a.transpose() * k * a).fullPivLu().solve(a.transpose() * k * b);
  const Exact relaxed = b.transpose() * k * (b - a * u);
  return relaxed.cast<double>();
}

/// Returns the inverse of K. Every entry has a random relative error of up to `noise`.
ApproximateInverse noisy_inverse(const SpringSystem& s, double noise) {
  Eigen::MatrixXd inverse = stiffness_of(s).inverse();
  const Eigen::MatrixXd random = Eigen::MatrixXd::Random(inverse.rows(), inverse.rows());
  inverse.array() *= 1.0 + noise * (random + random.transpose()).array() / 2.0;
  return {.apply = [inverse](const Eigen::VectorXd& b) -> Eigen::VectorXd { return inverse * b; },
          .smallest_ratio = 0.5};
}

void expect_within_bound(const Condensation& c, const Eigen::MatrixXd& expected, double relative) {
  for (int a = 0; a < expected.rows(); ++a)
    for (int b = 0; b < expected.cols(); ++b) {
      EXPECT_LE(std::abs(c.stiffness(a, b) - expected(a, b)), c.error(a, b));
      EXPECT_LE(c.error(a, b), relative * std::sqrt(expected(a, a) * expected(b, b)));
    }
}

TEST(Condensation, IsTheSchurComplementWithinItsBound) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::srand(seed);
    const SpringSystem s = random_springs(30, 20, 3, 0.1);
    // Each entry of the matrix has an error of 8 rounding units. The elimination multiplies the relative error: by the
    // sum of a row divided by the entry that is left after the elimination.
    expect_within_bound(condense(s, noisy_inverse(s, 0.0), {}), exact(s), 1e-12);
  }
}

TEST(Condensation, RefinesAwayWhatAnInverseMisses) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::srand(seed);
    const SpringSystem s = random_springs(30, 10, 2, 0.1);
    const Condensation c = condense(s, noisy_inverse(s, 1e-4), {.tolerance = 1e-14});
    EXPECT_GT(c.steps, 1);
    expect_within_bound(c, exact(s), 1e-12);
  }
}

TEST(Condensation, StopsAtTheToleranceAskedForAndItsBoundSaysSo) {
  std::srand(3);
  const SpringSystem s = random_springs(30, 10, 1, 0.1);
  const Condensation rough = condense(s, noisy_inverse(s, 1e-2), {.tolerance = 1e-3});
  const Condensation fine = condense(s, noisy_inverse(s, 1e-2), {.tolerance = 1e-13});
  EXPECT_LT(rough.steps, fine.steps);
  EXPECT_GT(rough.error(0, 0), fine.error(0, 0));
  EXPECT_LE(std::abs(rough.stiffness(0, 0) - exact(s)(0, 0)), rough.error(0, 0));
  EXPECT_LE(rough.error(0, 0), 2e-3 * fine.stiffness(0, 0));
}

TEST(Condensation, OfAnIndefiniteSystemIsItsStationaryValue) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::srand(seed);
    SpringSystem s = random_springs(30, 10, 2, 0.1);
    s.stiffness.head(8) *= -1.0;
    ApproximateInverse inverse = noisy_inverse(s, 1e-7);
    inverse.definite = false;
    inverse.inverse_norm = 2.0 * stiffness_of(s).inverse().norm();
    const Condensation c = condense(s, inverse, {.tolerance = 1e-14});
    const Eigen::MatrixXd difference = (c.stiffness - exact(s)).cwiseAbs();
    EXPECT_TRUE((difference.array() <= c.error.array()).all()) << "seed " << seed;
    EXPECT_LT(difference.maxCoeff(), 1e-10) << "seed " << seed;
  }
}

TEST(Condensation, GivesNoBoundWhereNothingIsKnownOfTheInverse) {
  std::srand(1);
  const SpringSystem s = random_springs(20, 10, 1, 0.1);
  ApproximateInverse inverse = noisy_inverse(s, 1e-9);
  inverse.smallest_ratio = 0.0;
  const Condensation c = condense(s, inverse, {});
  EXPECT_TRUE(std::isinf(c.error(0, 0)));
  EXPECT_NEAR(c.stiffness(0, 0), exact(s)(0, 0), 1e-13);
}

TEST(Condensation, WithoutFreeUnknownsIsTheEnergyOfTheSprings) {
  SpringSystem s;
  s.on_free.resize(2, 0);
  s.on_boundary.resize(2, 1);
  s.on_boundary << 1.0, 2.0;
  s.stiffness = Eigen::Vector2d(3.0, 5.0);
  const Condensation c = condense(s, {.apply = {}, .smallest_ratio = 1.0}, {});
  EXPECT_EQ(c.stiffness(0, 0), 23.0);
  EXPECT_LT(c.error(0, 0), 1e-12);
}

}  // namespace
}  // namespace floc
