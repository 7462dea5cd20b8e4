#include "floc/fitting/oedometer_test.h"

#include <fmt/format.h>

#include <cmath>

#include "floc/fitting/correlated_mean.h"

namespace floc {
namespace {

using TestPoints = std::vector<ShearPoint>;

/// Returns the points whose axial stress is larger than that of every earlier point.
TestPoints first_loading_of(const TestPoints& points) {
  TestPoints loading;
  for (const ShearPoint& p : points)
    if (p.axial_stress > 0.0 && (loading.empty() || p.axial_stress > loading.back().axial_stress))
      loading.push_back(p);
  return loading;
}

/// Returns the axial strain at an axial stress that lies between the stresses of the first and the last point.
double strain_at(const TestPoints& loading, double stress) {
  std::size_t k = 1;
  while (k + 1 < loading.size() && loading[k].axial_stress < stress) ++k;
  const ShearPoint &below = loading[k - 1], &above = loading[k];
  const double part = std::log(stress / below.axial_stress) / std::log(above.axial_stress / below.axial_stress);
  return below.axial_strain + part * (above.axial_strain - below.axial_strain);
}

}  // namespace

OedometerTest evaluate_oedometer_test(const TestPoints& points,
                                      const std::optional<std::pair<double, double>>& range) {
  OedometerTest test;
  const TestPoints loading = first_loading_of(points);
  if (loading.size() < 2) {
    test.failure_reason = "its axial stress does not grow";
    return test;
  }
  constexpr double kForgotten = 3.0;
  std::vector<double> ratios;
  for (const ShearPoint& p : loading)
    if (p.axial_stress >= kForgotten * loading.front().axial_stress)
      ratios.push_back(p.lateral_stress / p.axial_stress);
  if (!ratios.empty()) test.parameters.push_back(mean_along_path("K0", ratios));
  const double lowest = loading.front().axial_stress, highest = loading.back().axial_stress;
  const auto [low, high] = range.value_or(std::pair(std::max(lowest, 0.5 * highest), highest));
  // The stresses that a run reaches agree with the stresses prescribed by its scene only up to rounding.
  constexpr double kRounding = 1e-6;
  if (low < lowest * (1.0 - kRounding) || high > highest * (1.0 + kRounding)) {
    test.failure_reason = fmt::format(
        "its axial stress goes from {:.6g} to {:.6g}, which does not contain the range "
        "{:.6g} to {:.6g} of the constrained modulus",
        lowest, highest, low, high);
    return test;
  }
  test.modulus_range = {low, high};
  const double strain = strain_at(loading, high) - strain_at(loading, low);
  if (strain > 0.0) test.parameters.push_back(held_at("constrained_modulus", (high - low) / strain));
  return test;
}

}  // namespace floc
