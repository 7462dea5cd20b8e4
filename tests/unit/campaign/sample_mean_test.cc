#include "floc/campaign/sample_mean.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floc {
namespace {

TEST(SampleMean, IsThatOfAListByHand) {
  const SampleMean mean = mean_of_samples({1.0, 2.0, 6.0});
  EXPECT_EQ(mean.n, 3);
  EXPECT_DOUBLE_EQ(mean.mean, 3.0);
  EXPECT_DOUBLE_EQ(*mean.deviation, std::sqrt(7.0));  // variance (4 + 1 + 9)/2
  EXPECT_DOUBLE_EQ(*mean.standard_error(), std::sqrt(7.0 / 3.0));
  EXPECT_EQ(mean.low, 1.0);
  EXPECT_EQ(mean.high, 6.0);
}

TEST(SampleMean, OfOneSampleHasNoError) {
  const SampleMean mean = mean_of_samples({0.3});
  EXPECT_EQ(mean.mean, 0.3);
  EXPECT_FALSE(mean.deviation.has_value());
  EXPECT_FALSE(mean.standard_error().has_value());
  EXPECT_EQ(mean_of_samples({}).n, 0);
}

TEST(SampleMean, OfEqualValuesIsThatValue) {
  const SampleMean mean = mean_of_samples({0.1, 0.1, 0.1});
  EXPECT_EQ(mean.mean, 0.1);
  EXPECT_EQ(*mean.deviation, 0.0);
}

TEST(Difference, IsAllowedToBeTwoPointSixStandardErrors) {
  SampleMean mean;
  mean.n = 4;
  mean.mean = 1.0;
  mean.deviation = 0.2;  // so that s^2/n = 0.01

  const ReferenceMean reference{4, 1.2, 0.015};
  const Difference d = difference_of(mean, reference);
  EXPECT_DOUBLE_EQ(d.value, -0.2);
  EXPECT_DOUBLE_EQ(*d.allowed, 2.6 * std::sqrt(0.01 + 0.000225 / 4));
  EXPECT_TRUE(d.agrees);
  EXPECT_FALSE(difference_of(mean, {4, 1.27, 0.015}).agrees);
  EXPECT_FALSE(difference_of(mean, {1, 0.7, 0.0}).agrees);
}

TEST(Difference, OfOneSampleIsNotJudged) {
  EXPECT_FALSE(difference_of(mean_of_samples({1.0}), {1, 1.0, 0.1}).allowed.has_value());
}

}  // namespace
}  // namespace floc
