#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "floc/packing/equilibrium.h"

namespace floc {

/// What an equilibrium has to meet besides the tolerances of its residuals.
enum class Demand {
  none,
  lengths,       ///< axes have reached the lengths imposed
  response,      ///< the stress has answered to the load of the step
  density,       ///< the solid fraction, or the void ratio of a box, is steady
  stress,        ///< the stress that strained axes carry is steady
  contacts,      ///< no contact has opened or closed lately
  duration,      ///< the packing has been steady for long enough
  rest,          ///< kinetic energy of the grains that touch others
  wall_load,     ///< every wall has borne half of its pressure
  pressure,      ///< walls bear their pressure
  energy_ratio,  ///< kinetic over elastic energy, where the scene ends a compaction by it
  mechanisms,    ///< the structure that carries the load has none
  stability,     ///< the stiffness matrix has no negative eigenvalue
  liquid,        ///< liquid stays where it is when it is shared out once more
};
inline constexpr int kDemands = static_cast<int>(Demand::liquid) + 1;

/// The first demand that a packing does not meet.
struct Unmet {
  Demand demand = Demand::none;
  double value = 0.0;  ///< what was found; a number of them for mechanisms, stability and liquid
  double limit = 0.0;  ///< what it has to be below, where it has a limit
};

/// A demand that is not met, in words; empty where there is none.
std::string in_words(const Unmet& unmet);

/// The residual that is worst against its tolerance, with its grain; empty where all are below theirs.
/// @param id  of the grains; empty: they are named by their index
std::string worst_residual(const Residuals& residuals, const EquilibriumTolerance& tolerance,
                           std::span<const std::int64_t> id = {});

}  // namespace floc
