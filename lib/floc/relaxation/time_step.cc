#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "floc/contact/law_table.h"
#include "floc/relaxation/dynamics.h"

namespace floc {

template <int Dim>
double time_step_of(const Packing<Dim>& packing, double time_step_in_contact_times) {
  const Grains<Dim>& g = packing.grains;
  double shortest = std::numeric_limits<double>::infinity();
  const auto bound_of = [](const LawParameters& parameters) {
    return std::visit([](const auto& law) { return law.stiffness_bound(); }, compose_law(parameters));
  };
  ContactStiffness bound = bound_of(packing.law);
  if (!packing.walls.empty()) {
    const ContactStiffness on_wall = bound_of(packing.wall_law);
    bound = {std::max(bound.normal, on_wall.normal), std::max(bound.tangential, on_wall.tangential),
             std::max(bound.rolling, on_wall.rolling)};
  }
  // Springs across the contact vibrate faster than those along it where they are stiffer.
  const double stiffest = std::max(bound.normal, bound.tangential);
  for (int i = 0; i < g.size(); ++i) {
    shortest = std::min(shortest, std::sqrt(g.mass[i] / stiffest));
    // Rolling is stable to 1.45 times the step in units of its own period that vibration allows (measured in
    // crystals).
    if (bound.rolling > 0.0) shortest = std::min(shortest, 1.45 * std::sqrt(g.inertia(i) / bound.rolling));
  }
  return time_step_in_contact_times * shortest;
}

template double time_step_of(const Packing<2>&, double);

}  // namespace floc
