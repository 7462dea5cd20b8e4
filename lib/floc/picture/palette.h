#pragma once

#include <array>

namespace floc {

/// A colour in sRGB, with components in [0, 1].
struct Color {
  double red = 0.0, green = 0.0, blue = 0.0;
};

/// Returns the colour with the hexadecimal code 0xRRGGBB.
constexpr Color hex_color(int rgb) {
  return {(rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0};
}

/// Colours of the elements of a picture of a packing. A test checks that readers with any of the three kinds of colour
/// blindness can distinguish the colours of lines. Blue and vermilion are from the palette of Okabe and Ito; the green
/// is lighter than the green of that palette.
namespace palette {

inline constexpr Color kCompression = hex_color(0x0072B2);
inline constexpr Color kTension = hex_color(0xD55E00);
inline constexpr Color kDistant = hex_color(0x00B377);
inline constexpr Color kZero = hex_color(0x5A5A5A);
inline constexpr Color kBackground =
    hex_color(0xBDBDBD);  ///< colour of contacts that the picture does not emphasize
inline constexpr Color kLost = kTension;
inline constexpr Color kGained = kCompression;
inline constexpr Color kArrow = hex_color(0x222222);
inline constexpr Color kGrain = hex_color(0xEFEFEF);
inline constexpr Color kSphere = hex_color(0xD6D6D6);  ///< colour of grains in 3D, before shading
/// Colour of the small spheres at the ends of the tubes that show contacts.
inline constexpr Color kNode = hex_color(0x9C9C9C);
inline constexpr Color kRattler = hex_color(0xFFFFFF);
inline constexpr Color kOutline = hex_color(0xA6A6A6);
inline constexpr Color kCell = hex_color(0x707070);
inline constexpr Color kText = hex_color(0x202020);

/// Colour scale from orange (negative values) through white (zero) to blue (positive values), combined from the
/// ColorBrewer scales PuOr and RdBu.
inline constexpr std::array<Color, 9> kDiverging = {
    hex_color(0xB35806), hex_color(0xE08214), hex_color(0xFDB863), hex_color(0xFEE0B6), hex_color(0xFFFFFF),
    hex_color(0xD1E5F0), hex_color(0x92C5DE), hex_color(0x4393C3), hex_color(0x2166AC)};

/// Returns the colour of a value in [-1, 1], interpolated linearly between the entries of kDiverging. A value beyond an
/// end of this range has the colour of that end.
constexpr Color diverging(double value) {
  constexpr int kLast = static_cast<int>(kDiverging.size()) - 1;
  const double place = (value < -1.0 ? 0.0 : value > 1.0 ? 1.0 : 0.5 * (value + 1.0)) * kLast;
  const std::size_t below = place >= kLast ? kLast - 1 : static_cast<std::size_t>(place);
  const Color& a = kDiverging[below];
  const Color& b = kDiverging[below + 1];
  const double t = place - static_cast<double>(below);
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue)};
}

}  // namespace palette

}  // namespace floc
