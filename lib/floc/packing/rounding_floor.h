#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Imbalance that rounding of the stored numbers leaves in a packing, in units of F1 and F1/a^(Dim-1). No
/// stored state can be balanced better than this, whatever produced it.
struct RoundingFloor {
  /// Net force on a grain (F1): half a unit in the last place of its coordinates times the stiffness that holds
  /// it, and half a unit in the last place of the largest force.
  double force = 0.0;
  double stress = 0.0;  ///< change of the stress by a rounding of the sides of the cell (F1/a^(Dim-1))
};

/// Estimates the imbalance by rounding of a packing.
/// @param target_stress  stress on each axis, compression positive
template <int Dim>
RoundingFloor rounding_floor(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

}  // namespace floc
