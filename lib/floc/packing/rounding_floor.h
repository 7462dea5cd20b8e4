#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// The imbalance that rounding of the stored numbers leaves in a packing, in units of F1 and F1/a^(Dim-1): no
/// state stored in such numbers can be balanced better, whatever produced it.
struct RoundingFloor {
  /// Net force on a grain: half a unit in the last place of its coordinates times the stiffness that holds it.
  double force = 0.0;
  double stress = 0.0;  ///< the same for the sides of the cell
};

/// @param target_stress  stress on each axis, compression positive
template <int Dim>
RoundingFloor rounding_floor(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

}  // namespace floc
