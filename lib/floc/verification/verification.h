#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/packing/state.h"

namespace floc {

/// One condition for a state to be an equilibrium, checked from positions, springs and law alone.
struct Criterion {
  const char* name;
  std::optional<double> value;  ///< value found; none if it could not be tested
  double limit;                 ///< largest allowed value
  bool holds;                   ///< whether the criterion is met
  /// Grains or contacts that violate it, worst first, or the part that was not tested; empty if it holds.
  std::string where;
  bool by_value = true;  ///< whether a violation shows in value and limit
};

/// Recomputes the contacts of a state and measures the equilibrium on the result. The criteria are
///   geometry     stored gaps and normals of the contacts, against positions (length)
///   list         interactions within the range of the law that the list lacks, and listed contacts that are none
///   law          stored forces, moments, stiffnesses and flags, against the law and the springs (force)
///   force, moment, stress, energy   the four residuals, against the tolerances recorded in the state; between walls
///                     the stress is that of the pressure on each wall
///   mean_stress  recorded stress, against that of the recomputed forces, in units of the mean stress
///   stability    number of negative eigenvalues of the stiffness matrix, see Stability
///   boundary_balance  forces over areas of the faces of the cell, and of walls, against the stress (stress)
///   length, liquid    lengths imposed on axes, if any; bridges that would change, against the recorded number
///   recorded     number of recorded residuals, worst grains, eigenvalue counts, flags and forces on walls that
///                differ from those found
/// Geometry, law and mean stress are allowed the error by rounding of the positions; the boundary balance is allowed
/// the error by net forces within their tolerance.
template <int Dim>
std::vector<Criterion> verify_equilibrium(const State<Dim>& state);

}  // namespace floc
