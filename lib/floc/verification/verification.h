#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/packing/state.h"

namespace floc {

/// One condition for a state to be an equilibrium, checked from positions, springs and law alone.
struct Criterion {
  const char* name;
  std::optional<double> value;  ///< what was found; none where it could not be tested
  double limit;                 ///< the largest it may be
  bool holds;                   ///< nothing speaks against it
  /// The grains or contacts that break it, worst first; what a test did not cover; empty if it holds.
  std::string where;
  bool by_value = true;  ///< whether value and limit are what says that it does not hold
};

/// Recomputes everything that a state says about its contacts, and measures the equilibrium on the result:
///   geometry     gaps and normals of the contacts stored, against positions (length)
///   list         interactions in the law's range that the list lacks, and contacts it should not have
///   law          forces, moments, stiffnesses and flags stored, against the law and the springs (force)
///   force, moment, stress, energy   the four residuals, against the tolerances that the state had to meet;
///                     between walls the stress is that of the pressure on each wall
///   mean_stress  the stress recorded, against that of the forces recomputed, in units of the mean stress
///   stability    number of negative eigenvalues of the stiffness matrix, see Stability
///   boundary_balance  forces over areas of the faces of the cell, and of walls, against the stress (stress)
///   length, liquid    lengths imposed on axes, if any; bridges that would change, against those recorded
///   recorded     number of residuals, worst grains, eigenvalue counts, flags and forces on walls recorded that
///                differ from those found
/// Geometry, law and mean stress may be off by what rounding of the positions makes of them, the boundary by
/// what net forces within their tolerance do.
template <int Dim>
std::vector<Criterion> verify_equilibrium(const State<Dim>& state);

}  // namespace floc
