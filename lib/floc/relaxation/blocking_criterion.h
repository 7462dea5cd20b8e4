#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "floc/packing/equilibrium.h"

namespace floc {

/// Criteria that an equilibrium has to meet besides the tolerances of its residuals.
enum class Demand {
  none,
  lengths,    ///< all axes have reached their imposed lengths
  response,   ///< the stress has responded to the imposed load
  density,    ///< the solid fraction, or the void ratio of a packing between walls, is steady
  stress,     ///< the stress carried by axes with an imposed length is steady
  contacts,   ///< no contact has opened or closed for some time
  duration,   ///< the packing has been steady for long enough
  rest,       ///< the kinetic energy of the grains that interact with others is small
  wall_load,  ///< every wall has at some time borne half of its imposed pressure
  pressure,   ///< every wall bears its imposed pressure
  /// the ratio of kinetic to elastic energy is small; required only if this ratio ends a compaction
  energy_ratio,
  mechanisms,  ///< the structure that carries the load has no mechanisms (motions without stiffness)
  stability,   ///< the stiffness matrix has no negative eigenvalue
  liquid,      ///< no liquid bridge changes when the liquid is shared out once more
};
inline constexpr int kDemands = static_cast<int>(Demand::liquid) + 1;

/// First criterion of equilibrium that a packing does not meet, with the measured value and its limit.
struct Unmet {
  Demand demand = Demand::none;
  double value = 0.0;  ///< measured value; a count for mechanisms, stability and liquid
  double limit = 0.0;  ///< upper limit of the value, if the criterion has one
};

/// Returns a sentence that describes a criterion that is not met; empty for Demand::none.
std::string in_words(const Unmet& unmet);

/// Returns a text about the residual (of force, moment, stress or energy) with the largest ratio to its tolerance, and
/// the grain on which it occurs; empty if all residuals are below their tolerances.
/// @param id  identifiers of the grains; if empty, the text names grains by their indices
std::string worst_residual(const Residuals& residuals, const EquilibriumTolerance& tolerance,
                           std::span<const std::int64_t> id = {});

}  // namespace floc
