#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "floc/packing/equilibrium.h"

namespace floc {

/// Criteria that a packing has to meet in equilibrium, in addition to the tolerances of the residuals.
enum class Demand {
  none,
  lengths,   ///< all axes have reached their imposed lengths
  response,  ///< the stress has responded to the imposed load
  density,   ///< the solid fraction is steady; for a packing between walls: the void ratio
  stress,    ///< the stress on the axes with an imposed length is steady
  contacts,  ///< no contact has opened or closed for some time
  duration,  ///< the packing has been steady for long enough
  rest,      ///< the kinetic energy of the grains with contacts is small
  /// at some time the pressure of the grains on each wall was at least half of the imposed pressure
  wall_load,
  pressure,  ///< the pressure of the grains on every wall equals the imposed pressure
  /// the ratio of kinetic to elastic energy is small; required only if this ratio ends a compaction
  energy_ratio,
  mechanisms,  ///< the structure that carries the load has no mechanisms (motions without stiffness)
  stability,   ///< the stiffness matrix has no negative eigenvalue
  liquid,      ///< no liquid bridge would change if the liquid were shared out once more
};
inline constexpr int kDemands = static_cast<int>(Demand::liquid) + 1;

/// First criterion of equilibrium that a packing does not meet, with the measured value and its limit.
struct Unmet {
  Demand demand = Demand::none;
  double value = 0.0;  ///< measured value; for `mechanisms`, `stability` and `liquid` a count
  double limit = 0.0;  ///< upper limit of the value; unused by criteria without a limit
};

/// Returns a sentence about a criterion that is not met; empty for Demand::none.
std::string in_words(const Unmet& unmet);

/// Returns a text about the worst of the residuals of force, moment, stress and energy: the residual that is largest
/// when divided by its tolerance. The text names the grain with this residual. The text is empty if all residuals are
/// below their tolerances.
/// @param id  identifiers of the grains; if empty, the text names grains by their indices
std::string worst_residual(const Residuals& residuals, const EquilibriumTolerance& tolerance,
                           std::span<const std::int64_t> id = {});

}  // namespace floc
