#include "floc/base/double_double.h"

#include <gtest/gtest.h>

#include "floc/base/decimal.h"
#include "floc/base/parse_number.h"

namespace floc {
namespace {

DoubleDouble read(const char* text) {
  return decimal(text, parse_number<double>(text).value());
}

TEST(DoubleDouble, SumsKeepWhatADoubleDrops) {
  const DoubleDouble sum = exact_sum(1.0, 0x1p-80);
  EXPECT_EQ(sum.high, 1.0);
  EXPECT_EQ(sum.low, 0x1p-80);
  const DoubleDouble difference =
      sum + DoubleDouble{0x1p60, 0.0} - DoubleDouble{0x1p60, 0.0} - DoubleDouble{1.0, 0.0};
  // The smallest term, 2^-80, is 2^140 times smaller than the largest one, 2^60. The two parts of a
  // DoubleDouble together have only 106 bits, so the smallest term is lost.
  EXPECT_NEAR(difference.rounded(), 0.0, 0x1p-40);
  EXPECT_EQ((sum - DoubleDouble{1.0, 0.0}).rounded(), 0x1p-80);
}

TEST(DoubleDouble, ProductsAndSquaresAreExactWhereTheyFit) {
  const double x = 1.0 + 0x1p-40;
  const DoubleDouble product = exact_product(x, x);  // 1 + 2^-39 + 2^-80
  EXPECT_EQ(product.high, 1.0 + 0x1p-39);
  EXPECT_EQ(product.low, 0x1p-80);
  const DoubleDouble s = square(DoubleDouble{1.0, 0x1p-60});  // 1 + 2^-59 + 2^-120
  EXPECT_EQ(s.high, 1.0);
  EXPECT_EQ(s.low, 0x1p-59 + 0x1p-120);
}

TEST(DoubleDouble, QuotientsTimesTheirDivisorsAreWhatTheyWere) {
  const DoubleDouble third = DoubleDouble{1.0, 0.0} / 3.0;
  EXPECT_NEAR((third * 3.0 - DoubleDouble{1.0, 0.0}).rounded(), 0.0, 0x1p-103);
  EXPECT_NE(third.low, 0.0);
}

TEST(Decimal, OfMoreDigitsThanADoubleHasKeepsThem) {
  const DoubleDouble x = read("1000000000.123456789012345678");
  EXPECT_EQ(x.high, 1000000000.123456789012345678);
  EXPECT_NEAR((x - DoubleDouble{1e9, 0.0}).rounded(), 0.123456789012345678, 0x1p-53);
  const DoubleDouble y = read(" -1000000000123456789012345678e-18 ");
  EXPECT_NEAR((y + DoubleDouble{1e9, 0.0}).rounded(), -0.123456789012345678, 0x1p-53);
  const DoubleDouble z = read("0.0000000001000000000123456789012345678");
  EXPECT_NEAR((z * 1e10 - DoubleDouble{1.0, 0.0}).rounded(), 1.23456789012345678e-10, 1e-25);
}

TEST(Decimal, OfADoubleIsThatDouble) {
  for (const char* text :
       {"0.1", "-3.1415926535897931", "1e300", "12345678901234567", "0", "-0.0", "2.2250738585072014e-308"})
    EXPECT_EQ(read(text).low, 0.0) << text;
}

TEST(Decimal, NearTheEndsOfDoublesHasNoSecondPartLargerThanALastDigit) {
  for (const char* text :
       {"1234567890123456789012345e-330", "12345678901234567890123456e280", "1234567890123456789e-340"})
    EXPECT_LE(std::abs(read(text).low), 0x1p-52 * read(text).high) << text;
}

}  // namespace
}  // namespace floc
