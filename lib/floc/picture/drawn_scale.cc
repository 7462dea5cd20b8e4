#include "floc/picture/drawn_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "floc/packing/grain_sizes.h"

namespace floc {

template <int Dim>
double mean_diameter(const PackingPicture<Dim>& picture) {
  if (picture.shape.empty()) return mean_diameter(picture.radius);
  double sum = 0.0;
  for (const DrawnShape<Dim>& grain : picture.shape) sum += grain.scale * grain.shape->equal_volume_diameter();
  return sum / static_cast<double>(picture.shape.size());
}

template <int Dim>
double rms_force(const PackingPicture<Dim>& picture) {
  double sum = 0.0;
  int n = 0;
  for (const ContactLine<Dim>& line : picture.lines)
    if (line.force > 0.0) sum += line.force * line.force, ++n;
  return n == 0 ? 0.0 : std::sqrt(sum / n);
}

template <int Dim>
double rms_displacement(const PackingPicture<Dim>& picture) {
  double sum = 0.0;
  for (const DisplacementArrow<Dim>& arrow : picture.arrows) sum += arrow.displacement.squaredNorm();
  return picture.arrows.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(picture.arrows.size()));
}

double round_number_below(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  // Without the last factor, rounding errors of the logarithm or the quotient could change the result for 0.2 into 0.1.
  const double digit = x / power * (1.0 + 1e-12);
  return power * (digit >= 10.0 ? 10.0 : digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0);
}

std::string short_number(double x) {
  std::string text = fmt::format("{:.3g}", x);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  constexpr std::array<const char*, 10> kRaised = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string result = text.substr(0, e) + "×10";
  if (text[e + 1] == '-') result += "⁻";
  for (const char digit : std::to_string(std::abs(std::stoi(text.substr(e + 1)))))
    result += kRaised[static_cast<std::size_t>(digit - '0')];
  return result.starts_with("1×") ? result.substr(std::string("1×").size()) : result;
}

template double mean_diameter(const PackingPicture<2>&);
template double mean_diameter(const PackingPicture<3>&);
template double rms_force(const PackingPicture<2>&);
template double rms_force(const PackingPicture<3>&);
template double rms_displacement(const PackingPicture<2>&);
template double rms_displacement(const PackingPicture<3>&);

}  // namespace floc
