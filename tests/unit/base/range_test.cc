#include "floc/base/range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "floc/base/error.h"

namespace floc::test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr NumberRange kShare{.least = 0.0, .most = 1.0};

TEST(Range, HoldsItsEndsAndNothingThatIsNotFinite) {
  for (const NumberRange& range : {kFiniteNumber, kPositiveNumber, kNotNegativeNumber, kShare})
    for (const double x : {std::nan(""), kInf, -kInf}) EXPECT_FALSE(range.holds(x)) << range.words();
  EXPECT_TRUE(kFiniteNumber.holds(-std::numeric_limits<double>::max()));
  EXPECT_TRUE(kFiniteNumber.holds(std::numeric_limits<double>::max()));
  EXPECT_FALSE(kPositiveNumber.holds(0.0));
  EXPECT_TRUE(kPositiveNumber.holds(std::numeric_limits<double>::denorm_min()));
  EXPECT_TRUE(kNotNegativeNumber.holds(0.0));
  EXPECT_TRUE(kShare.holds(0.0) && kShare.holds(1.0));
  EXPECT_FALSE(kShare.holds(std::nextafter(1.0, 2.0)));
  EXPECT_TRUE(WholeRange({.least = 2, .most = 3}).holds(3));
  EXPECT_FALSE(WholeRange({.least = 2, .most = 3}).holds(4));
}

TEST(Range, SaysNameValueAndRequirement) {
  EXPECT_EQ(range_fault("x", 0.5, kShare), "");
  EXPECT_EQ(range_fault("x", 2.0, kShare), "x = 2: expected a number from 0 to 1");
  EXPECT_EQ(range_fault("x", -kInf, kFiniteNumber), "x = -inf: expected a finite number");
  EXPECT_EQ(range_fault("x", -1.0, kPositiveNumber), "x = -1: expected a positive number");
  EXPECT_EQ(range_fault("x", std::nan(""), kNotNegativeNumber), "x = nan: expected zero or a positive number");
  EXPECT_EQ(range_fault("n", 0, kPositiveWhole), "n = 0: expected a whole number of at least 1");
  EXPECT_THAT([] { require_in_range("n", 1, WholeRange{.least = 2, .most = 9}); },
              ThrowsMessage<InputError>(HasSubstr("n = 1: expected a whole number from 2 to 9")));
  EXPECT_THAT([] { refuse_faults({"a", "b"}); }, ThrowsMessage<InputError>(HasSubstr("a; b")));
  EXPECT_NO_THROW(refuse_faults({}));
}

}  // namespace
}  // namespace floc::test
