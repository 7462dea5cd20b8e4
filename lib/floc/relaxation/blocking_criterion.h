#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "floc/packing/equilibrium.h"

namespace floc {

/// Criteria of an equilibrium besides the tolerances of its residuals.
enum class Demand {
  none,
  lengths,       ///< axes have reached the lengths imposed
  response,      ///< the stress has responded to the load of the step
  density,       ///< the solid fraction, or the void ratio of a box, is steady
  stress,        ///< the stress that strained axes carry is steady
  contacts,      ///< no contact has opened or closed lately
  duration,      ///< the packing has been steady for long enough
  rest,          ///< the kinetic energy of the grains that touch others is small
  wall_load,     ///< every wall has borne half of its pressure
  pressure,      ///< every wall bears its pressure
  energy_ratio,  ///< kinetic over elastic energy is small, where it ends a compaction
  mechanisms,    ///< the structure that carries the load has no mechanisms
  stability,     ///< the stiffness matrix has no negative eigenvalue
  liquid,        ///< no bridge changes when the liquid is shared out once more
};
inline constexpr int kDemands = static_cast<int>(Demand::liquid) + 1;

/// First criterion that a packing does not meet.
struct Unmet {
  Demand demand = Demand::none;
  double value = 0.0;  ///< measured value; for mechanisms, stability and liquid a count
  double limit = 0.0;  ///< upper limit of the value, where the criterion has one
};

/// Unmet criterion in words; empty if there is none.
std::string in_words(const Unmet& unmet);

/// Residual with the largest ratio to its tolerance, with its grain, in words; empty if all are below their
/// tolerances.
/// @param id  identifiers of the grains; empty: their indices
std::string worst_residual(const Residuals& residuals, const EquilibriumTolerance& tolerance,
                           std::span<const std::int64_t> id = {});

}  // namespace floc
