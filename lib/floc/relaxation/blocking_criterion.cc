#include "floc/relaxation/blocking_criterion.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace floc {

std::string in_words(const Unmet& unmet) {
  const auto against = [&unmet](const char* what) {
    return fmt::format("{} {:.2e} against {:.0e}", what, unmet.value, unmet.limit);
  };
  // There is no default case, so that the compiler names a demand without words.
  switch (unmet.demand) {
    case Demand::none:
      return "";
    case Demand::lengths:
      return "the axes have not reached the lengths imposed";
    case Demand::response:
      return against("the stress has not answered to the load of this step: off by");
    case Demand::density:
      return against("the density is not steady: it changes by");
    case Demand::stress:
      return against("the stress of the axes with a length imposed is not steady: it changes by");
    case Demand::contacts:
      return "contacts still open and close";
    case Demand::duration:
      return "the packing has not been steady for long enough";
    case Demand::rest:
      return against("the grains still move: their kinetic energy is");
    case Demand::wall_load:
      return "a wall has not yet borne half of its pressure";
    case Demand::pressure:
      return against("walls are off their pressure by");
    case Demand::energy_ratio:
      return against("kinetic over elastic energy is");
    case Demand::mechanisms:
      return fmt::format("the structure that carries the load has {:.0f} mechanisms, expected none",
                         unmet.value);
    case Demand::stability:
      return fmt::format(
          "at rest but not stable: {:.0f} negative eigenvalues of the stiffness matrix, expected "
          "none",
          unmet.value);
    case Demand::liquid:
      // Even if no bridge forms or breaks, the volumes of the bridges may still change.
      return unmet.value > 0.0
                 ? fmt::format("liquid still moves: {:.0f} bridges would form or break", unmet.value)
                 : "liquid still moves between the bridges";
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
  const std::string where = worst->grain >= 0 ? fmt::format(" (grain {})", name(worst->grain)) : "";
  return fmt::format("{} {:.2e} against {:.0e}{}", worst->name, worst->value, worst->tolerance, where);
}

}  // namespace floc
