#include "floc/picture/drawn_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floc {
namespace {

TEST(DrawnScale, RoundNumbersAreOneTwoFive) {
  EXPECT_DOUBLE_EQ(round_number_below(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_number_below(1.99), 1.0);
  EXPECT_DOUBLE_EQ(round_number_below(0.2), 0.2);
  EXPECT_DOUBLE_EQ(round_number_below(0.499), 0.2);
  EXPECT_DOUBLE_EQ(round_number_below(7e-6), 5e-6);
  EXPECT_DOUBLE_EQ(round_number_below(3e7), 2e7);
  for (int e = -12; e < 12; ++e)
    EXPECT_NEAR(round_number_below(std::pow(10.0, e)) / std::pow(10.0, e), 1.0, 1e-9);
}

TEST(DrawnScale, NumbersAreShort) {
  EXPECT_EQ(short_number(0.42169), "0.422");
  EXPECT_EQ(short_number(13.33), "13.3");
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(2.5e-5), "2.5×10⁻⁵");
  EXPECT_EQ(short_number(1e-10), "10⁻¹⁰");
  EXPECT_EQ(short_number(1e6), "10⁶");
}

TEST(DrawnScale, MeansAreOfWhatIsThere) {
  PackingPicture<2> picture;
  picture.radius = {0.5, 0.25};
  EXPECT_DOUBLE_EQ(mean_diameter(picture), 0.75);
  EXPECT_EQ(rms_force(picture), 0.0);
  EXPECT_EQ(rms_displacement(picture), 0.0);
  for (const double force : {3.0, 4.0, 0.0}) picture.lines.emplace_back().force = force;
  EXPECT_DOUBLE_EQ(rms_force(picture), std::sqrt(12.5));
}

}  // namespace
}  // namespace floc
