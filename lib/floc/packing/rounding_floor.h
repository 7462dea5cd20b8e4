#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// What the rounding of the numbers that a packing is kept in leaves of its equilibrium, in units of F1 and
/// F1/a^(Dim-1): no state of these numbers can be balanced better, whatever brought it there.
struct RoundingFloor {
  /// Net force on a grain: half a unit in the last place of its coordinates times what holds it.
  double force = 0.0;
  double stress = 0.0;  ///< the same of the sides of the cell
};

/// @param target_stress  stress on each axis, compression positive
template <int Dim>
RoundingFloor rounding_floor(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

}  // namespace floc
