#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Imbalance of a packing that results from the rounding of the stored numbers. A stored state cannot have a smaller
/// imbalance, even if it was computed exactly.
struct RoundingFloor {
  /// Net force on a grain, in units of the force scale F1 of the packing. This force is the sum of two errors. The
  /// first is the rounding error of the largest coordinate, times the largest sum of the stiffnesses of the contacts of
  /// a grain. The second is half a unit in the last place of the largest contact force.
  double force = 0.0;
  /// Error of the stress that results from the rounding of the sides of the cell, in units of F1/a^(Dim-1) with the
  /// force scale F1 and the largest diameter a.
  double stress = 0.0;
};

/// Estimates the imbalance of a packing that results from rounding.
/// @param target_stress  stress imposed on each axis, compression positive
template <int Dim>
RoundingFloor rounding_floor(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

}  // namespace floc
