#include "floc/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace floc {
namespace {

TEST(RandomStream, IsSplitMix64) {
  // First outputs of the reference implementation (S. Vigna, splitmix64.c), started from the state 1234567.
  RandomStream random(1234567);
  for (const std::uint64_t expected : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                       4593380528125082431u, 16408922859458223821u})
    EXPECT_EQ(random.next(), expected);
}

TEST(RandomStream, ContinuesFromItsSavedState) {
  RandomStream unbroken(42, 1);
  for (int k = 0; k < 10; ++k) unbroken.normal();
  RandomStream resumed(unbroken.state());
  for (int k = 0; k < 10; ++k) EXPECT_EQ(resumed.normal(), unbroken.normal());
}

TEST(RandomStream, SeedsAndPurposesGiveDifferentStreams) {
  const std::vector<RandomStream> streams = {RandomStream(1, 1), RandomStream(1, 2), RandomStream(2, 1),
                                             RandomStream(2, 2)};
  for (std::size_t a = 0; a < streams.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      RandomStream first = streams[a], second = streams[b];
      int n_equal = 0;
      for (int k = 0; k < 100; ++k) n_equal += first.next() == second.next();
      EXPECT_EQ(n_equal, 0);
    }
}

TEST(RandomStream, UniformHasTheMomentsOfItsInterval) {
  RandomStream random(3, 1);
  const int n = 100000;
  double sum = 0.0, squares = 0.0;
  for (int k = 0; k < n; ++k) {
    const double x = random.uniform(-1.0, 3.0);
    ASSERT_GE(x, -1.0);
    ASSERT_LT(x, 3.0);
    sum += x;
    squares += (x - 1.0) * (x - 1.0);
  }
  // The tolerances are five standard errors. The standard error is 4/sqrt(12 n) for the mean and 4^2/sqrt(180
  // n) for the variance.
  EXPECT_NEAR(sum / n, 1.0, 5 * 4 / std::sqrt(12.0 * n));
  EXPECT_NEAR(squares / n, 16.0 / 12.0, 5 * 16 / std::sqrt(180.0 * n));
}

TEST(RandomStream, NormalHasUnitVarianceAndGaussianKurtosis) {
  RandomStream random(4, 1);
  const int n = 100000;
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  for (int k = 0; k < n; ++k) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
  }
  // The tolerances are five standard errors. The variances of x, x^2 and x^4 are 1, 2 and 96.
  EXPECT_NEAR(sum / n, 0.0, 5 * std::sqrt(1.0 / n));
  EXPECT_NEAR(squares / n, 1.0, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourths / n, 3.0, 5 * std::sqrt(96.0 / n));
}

TEST(RandomStream, BelowReachesEveryIntegerAndNoOther) {
  RandomStream random(5, 1);
  std::vector<int> hits(7, 0);
  for (int k = 0; k < 7000; ++k) ++hits.at(random.below(7));
  // The counts have a binomial distribution with mean 1000 and standard deviation 29. The tolerance is six of these
  // standard deviations.
  for (const int count : hits) EXPECT_NEAR(count, 1000, 6 * 29);
}

}  // namespace
}  // namespace floc
