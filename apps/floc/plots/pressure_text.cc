#include "plots/pressure_text.h"

#include <fmt/format.h>

#include "floc/packing/equilibrium.h"
#include "floc/packing/packing.h"
#include "floc/picture/drawn_scale.h"

namespace floc {

template <int Dim>
bool has_reduced_pressure(const State<Dim>& state) {
  return !state.packing.law.is_rigid() || state.packing.law.adheres();
}

template <int Dim>
std::string pressure_value(const State<Dim>& state) {
  const auto number = [&](double stress) {
    return short_number(has_reduced_pressure(state) ? reduced_pressure(state.packing, stress) : stress);
  };
  const std::string mean = number(state.target_stress.mean());
  if (state.path.turn.empty()) return mean;
  return fmt::format("{} (mean), {} (driven)", mean,
                     number(stress_on_driven_axis<Dim>(state, state.target_stress)));
}

std::string mean_pressure_label(bool some_are_driven) {
  return some_are_driven ? "P* of the mean stress" : "P*";
}

template bool has_reduced_pressure(const State<2>&);
template bool has_reduced_pressure(const State<3>&);
template std::string pressure_value(const State<2>&);
template std::string pressure_value(const State<3>&);

}  // namespace floc
