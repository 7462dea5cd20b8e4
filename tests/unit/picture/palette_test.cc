#include "floc/picture/palette.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

namespace floc {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Returns the linear light intensities of a colour.
Vector3d linear(const Color& c) {
  const auto decode = [](double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); };
  return {decode(c.red), decode(c.green), decode(c.blue)};
}

/// Converts linear sRGB to CIE L*a*b* with the white point D65.
Vector3d lab(const Vector3d& rgb) {
  Matrix3d to_xyz;
  to_xyz << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Vector3d white(0.95047, 1.0, 1.08883);
  const Vector3d xyz = (to_xyz * rgb).cwiseQuotient(white);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  return {116.0 * f(xyz[1]) - 16.0, 500.0 * (f(xyz[0]) - f(xyz[1])), 200.0 * (f(xyz[1]) - f(xyz[2]))};
}

/// Returns matrices that map linear light to the light that is perceived with normal vision (first matrix) and with
/// full protanopia, deuteranopia and tritanopia. The values are those of Machado, Oliveira and Fernandes, IEEE Trans.
/// Vis. Comput. Graph. 15, 1291 (2009), for severity 1.
std::vector<Matrix3d> sights() {
  std::vector<Matrix3d> m(4);
  m[0] = Matrix3d::Identity();
  m[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
  m[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
  m[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
  return m;
}

/// Returns the difference of two colours in CIE L*a*b*, for the kind of vision with which the difference is smallest. A
/// difference of about 2.3 is just noticeable.
double least_difference(const Color& a, const Color& b) {
  double least = 1e9;
  for (const Matrix3d& sight : sights())
    least = std::min(least, (lab((sight * linear(a)).cwiseMax(0.0).cwiseMin(1.0)) -
                             lab((sight * linear(b)).cwiseMax(0.0).cwiseMin(1.0)))
                                .norm());
  return least;
}

TEST(Palette, KindsOfContactsStayApartForColourBlindReaders) {
  const std::vector<Color> kinds = {palette::kCompression, palette::kTension, palette::kZero, palette::kDistant,
                                    palette::kBackground};
  for (std::size_t i = 0; i < kinds.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(least_difference(kinds[i], kinds[j]), 20.0) << i << " and " << j;
  EXPECT_GT(least_difference(palette::kLost, palette::kGained), 20.0);
  // This tests least_difference() itself: with colour blindness, red and green of equal lightness can hardly be
  // distinguished.
  EXPECT_LT(least_difference(hex_color(0xC00000), hex_color(0x5A6E00)), 20.0);
}

TEST(Palette, TheEndsOfTheScaleOfPressuresStayApart) {
  for (const double value : {0.25, 0.5, 1.0})
    EXPECT_GT(least_difference(palette::diverging(value), palette::diverging(-value)), 20.0) << value;
}

TEST(Palette, ZeroPressureIsWhiteAndTheScaleEndsBeyondOne) {
  EXPECT_EQ(palette::diverging(0.0).red, 1.0);
  EXPECT_EQ(palette::diverging(0.0).blue, 1.0);
  EXPECT_EQ(palette::diverging(7.0).blue, palette::kDiverging.back().blue);
  EXPECT_EQ(palette::diverging(-7.0).red, palette::kDiverging.front().red);
}

}  // namespace
}  // namespace floc
