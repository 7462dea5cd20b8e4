#include "floc/loading/load_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace floc {
namespace {

/// Tolerance for rounding errors in the number of steps of a stage. A last step that would be shorter than this
/// fraction of the other steps is not made.
constexpr double kRoundingPerStep = 1e-6;

/// Returns n pressures in geometric progression that follow the pressure `from`; `from` itself is not in the list. The
/// last pressure is exactly `to`.
/// @param log10_factor  decimal logarithm of the ratio of two successive pressures; the last ratio may be closer to 1
std::vector<double> geometric(double from, double to, double log10_factor, int n) {
  std::vector<double> pressures;
  for (int k = 1; k < n; ++k) pressures.push_back(from * std::pow(10.0, k * log10_factor));
  pressures.push_back(to);
  return pressures;
}

}  // namespace

double LoadStage::largest_strain() const {
  double largest = std::abs(shear);
  for (const AxisLoad& load : axes)
    if (load.kind == AxisLoad::strain) largest = std::max(largest, std::abs(load.end));
  return largest;
}

std::vector<double> stage_pressures(double from, const LoadStage& stage) {
  assert(from >= 0 && stage.to >= 0);
  if (from == stage.to || from == 0.0 || stage.to == 0.0) return {stage.to};
  assert(stage.steps.has_value() != stage.steps_per_decade.has_value());
  const double decades = std::log10(stage.to / from);
  if (stage.steps) return geometric(from, stage.to, decades / *stage.steps, *stage.steps);
  const double step = std::copysign(1.0 / *stage.steps_per_decade, decades);
  const int n = std::max(1, static_cast<int>(std::ceil(decades / step - kRoundingPerStep)));
  return geometric(from, stage.to, step, n);
}

bool is_isotropic(const KnownStress& stress) {
  return std::all_of(stress.begin(), stress.end(),
                     [&](const std::optional<double>& s) { return s.has_value() && s == stress.front(); });
}

KnownStress after_stage(const KnownStress& from, const LoadStage& stage) {
  if (stage.is_isotropic()) return KnownStress(from.size(), stage.to);
  KnownStress after = from;
  for (std::size_t a = 0; a < stage.axes.size(); ++a) {
    if (stage.axes[a].kind == AxisLoad::stress) after[a] = stage.axes[a].end;
    if (stage.axes[a].kind == AxisLoad::strain) after[a].reset();
  }
  return after;
}

int number_of_steps(const KnownStress& from, const LoadStage& stage) {
  if (stage.steps) return *stage.steps;
  double decades = 0.0;
  for (std::size_t a = 0; a < from.size(); ++a) {
    const double to = stage.is_isotropic() ? stage.to : stage.axes[a].end;
    const bool moves = stage.is_isotropic() || stage.axes[a].kind == AxisLoad::stress;
    if (moves && from[a].value_or(0.0) > 0.0 && to > 0.0)
      decades = std::max(decades, std::abs(std::log10(to / *from[a])));
  }
  const double steps = decades * stage.steps_per_decade.value_or(1.0);
  return std::max(1, static_cast<int>(std::ceil(steps - kRoundingPerStep)));
}

namespace {

double stress_on_the_way(double from, double to, double share) {
  if (share == 1.0) return to;
  if (from > 0.0 && to > 0.0) return from * std::pow(to / from, share);
  return from + share * (to - from);
}

}  // namespace

template <int Dim>
LoadTarget<Dim> load_target(const std::vector<AxisStep>& axes, const StageReference& turn) {
  LoadTarget<Dim> target;
  for (int a = 0; a < Dim; ++a) {
    const auto& [load, share] = axes[static_cast<std::size_t>(a)];
    const double stress = turn.stress[static_cast<std::size_t>(a)];
    if (load.kind == AxisLoad::strain)
      target.side[a] = turn.sides[static_cast<std::size_t>(a)] * std::exp(-share * load.end);
    else
      target.stress[a] =
          load.kind == AxisLoad::kept_stress ? stress : stress_on_the_way(stress, load.end, share);
  }
  return target;
}

template LoadTarget<2> load_target(const std::vector<AxisStep>&, const StageReference&);
template LoadTarget<3> load_target(const std::vector<AxisStep>&, const StageReference&);

}  // namespace floc
