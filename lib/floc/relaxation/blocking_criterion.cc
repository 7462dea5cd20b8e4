#include "floc/relaxation/blocking_criterion.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace floc {

std::string in_words(const Unmet& unmet) {
  const auto against = [&unmet](const char* what) {
    return fmt::format("{} {:.2e} (limit {:.0e})", what, unmet.value, unmet.limit);
  };
  // The switch has no default case, so that the compiler warns if a criterion has no text.
  switch (unmet.demand) {
    case Demand::none:
      return "";
    case Demand::lengths:
      return "the axes have not yet reached their imposed lengths";
    case Demand::response:
      return against(
          "the stress has not yet responded to the load of this step: the residual of the stress is");
    case Demand::density:
      return against("the density is not steady: it changes by");
    case Demand::stress:
      return against("the stress on the axes with an imposed length is not steady: it changes by");
    case Demand::contacts:
      return "contacts still open and close";
    case Demand::duration:
      return "the packing has not been steady for long enough";
    case Demand::rest:
      return against(
          "the grains still move: their mean kinetic energy, in units of force scale times largest diameter, "
          "is");
    case Demand::wall_load:
      return "the forces of the grains on the walls have not yet reached half of the load (imposed pressures "
             "and weight)";
    case Demand::pressure:
      return against(
          "the pressure on the walls does not yet equal the imposed pressure: the largest relative difference "
          "is");
    case Demand::energy_ratio:
      return against("the ratio of kinetic to elastic energy is not yet small: it is");
    case Demand::mechanisms:
      return fmt::format(
          "the structure that carries the load still has {:.0f} mechanisms (motions without stiffness)",
          unmet.value);
    case Demand::stability:
      return fmt::format(
          "the packing is at rest but not stable: its stiffness matrix has {:.0f} negative eigenvalues",
          unmet.value);
    case Demand::liquid:
      // If the value is zero, no bridge would form or break, but the volumes of bridges would change.
      return unmet.value > 0.0 ? fmt::format(
                                     "liquid still moves: {:.0f} bridges would form or break if the liquid "
                                     "were shared out once more",
                                     unmet.value)
                               : "liquid still moves: the volumes of bridges would change if the liquid were "
                                 "shared out once more";
  }
  return "";
}

std::string worst_residual(const Residuals& residuals, const EquilibriumTolerance& t,
                           std::span<const std::int64_t> id) {
  struct Criterion {
    const char* name;
    double value, tolerance;
    int grain;
  };
  const Criterion criteria[] = {{"force", residuals.force, t.force, residuals.worst_force_grain},
                                {"moment", residuals.moment, t.moment, residuals.worst_moment_grain},
                                {"stress", residuals.stress, t.stress, -1},
                                {"energy", residuals.energy, t.energy, -1}};
  const Criterion* worst = std::max_element(
      std::begin(criteria), std::end(criteria),
      [](const auto& p, const auto& q) { return p.value * q.tolerance < q.value * p.tolerance; });
  if (worst->value < worst->tolerance) return "";
  const auto name = [&](int grain) { return id.empty() ? grain : id[grain]; };
  const std::string where = worst->grain >= 0 ? fmt::format(", on grain {}", name(worst->grain)) : "";
  return fmt::format("{} residual {:.2e} (tolerance {:.0e}){}", worst->name, worst->value, worst->tolerance,
                     where);
}

}  // namespace floc
