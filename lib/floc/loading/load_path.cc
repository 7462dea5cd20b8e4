#include "floc/loading/load_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace floc {
namespace {

/// Fraction of a step below which a remainder is rounding, not a step of its own.
constexpr double kRoundingOfAStep = 1e-6;

/// `n` pressures from * factor^k, the last replaced by `to`.
std::vector<double> geometric(double from, double to, double log10_factor, int n) {
  std::vector<double> pressures;
  for (int k = 1; k < n; ++k) pressures.push_back(from * std::pow(10.0, k * log10_factor));
  pressures.push_back(to);
  return pressures;
}

}  // namespace

std::vector<double> stage_pressures(double from, const LoadStage& stage) {
  assert(from >= 0 && stage.to >= 0);
  if (from == stage.to || from == 0.0 || stage.to == 0.0) return {stage.to};
  assert(stage.steps.has_value() != stage.steps_per_decade.has_value());
  const double decades = std::log10(stage.to / from);
  if (stage.steps) return geometric(from, stage.to, decades / *stage.steps, *stage.steps);
  const double step = std::copysign(1.0 / *stage.steps_per_decade, decades);
  const int n = std::max(1, static_cast<int>(std::ceil(decades / step - kRoundingOfAStep)));
  return geometric(from, stage.to, step, n);
}

}  // namespace floc
