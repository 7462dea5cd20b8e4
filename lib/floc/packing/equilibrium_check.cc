#include "floc/packing/equilibrium_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace floc {

template <int Dim>
std::string equilibrium_faults(const State<Dim>& state) {
  if (state.motion) return "";
  const Residuals r = residuals(state.packing, state.target_stress);
  const EquilibriumTolerance& t = state.tolerance;
  std::string faults;
  const auto check = [&](const std::string& what, double value, double limit) {
    if (!(value < limit))
      faults += fmt::format("{}{} is {:.3g}, but the limit is {:.3g}", faults.empty() ? "" : "; ", what, value,
                            limit);
  };
  // If the packing has no grains, the index of the grain with the largest residual is negative.
  const auto name = [&](int grain) { return grain < 0 ? grain : state.packing.grains.name(grain); };
  check(fmt::format("net force of grain {} in units of the force scale F1", name(r.worst_force_grain)), r.force,
        t.force);
  check(fmt::format("net moment of grain {} in units of F1 a (force scale F1, largest diameter a)",
                    name(r.worst_moment_grain)),
        r.moment, t.moment);
  check(
      "deviation from the imposed stress in units of F1/a^(d-1) (force scale F1, largest diameter a, d "
      "dimensions)",
      r.stress, t.stress);
  check("kinetic energy per grain in units of F1 a (force scale F1, largest diameter a)", r.energy, t.energy);
  return faults;
}

template <int Dim>
double equilibrium_excess(const State<Dim>& state) {
  const Residuals r = residuals(state.packing, state.target_stress);
  const EquilibriumTolerance& t = state.tolerance;
  return std::max({r.force / t.force, r.moment / t.moment, r.stress / t.stress, r.energy / t.energy});
}

template std::string equilibrium_faults(const State<2>&);
template std::string equilibrium_faults(const State<3>&);
template double equilibrium_excess(const State<2>&);
template double equilibrium_excess(const State<3>&);

}  // namespace floc
