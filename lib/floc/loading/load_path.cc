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

std::vector<double> turn_pressures(double from, const LoadTurn& turn) {
  assert(from >= 0 && turn.to >= 0);
  if (from == turn.to || from == 0.0 || turn.to == 0.0) return {turn.to};
  assert(turn.steps.has_value() != turn.steps_per_decade.has_value());
  const double decades = std::log10(turn.to / from);
  if (turn.steps) return geometric(from, turn.to, decades / *turn.steps, *turn.steps);
  const double step = std::copysign(1.0 / *turn.steps_per_decade, decades);
  const int n = std::max(1, static_cast<int>(std::ceil(decades / step - kRoundingOfAStep)));
  return geometric(from, turn.to, step, n);
}

}  // namespace floc
