#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/packing/state.h"

namespace floc {

/// One thing a state has to be to be an equilibrium, as found from positions, springs and law alone.
struct Criterion {
  const char* name;
  std::optional<double> value;  ///< what was found; none where it could not be tested
  double limit;                 ///< what it may be
  bool holds;                   ///< nothing speaks against it
  /// The grains or contacts that break it, worst first; what a test did not cover; empty if it holds.
  std::string where;
};

/// Recomputes everything a state says of its contacts, and measures the equilibrium on what was recomputed:
///   geometry     gaps and normals of the contacts stored, against positions (length)
///   list         interactions in the law's range that the list misses, and contacts it has too many
///   law          forces, moments, stiffnesses and flags stored, against the law and the springs (force)
///   force, moment, stress, energy   the four residuals, against the tolerances the state was asked to meet;
///                     between walls the stress is that of the pressure on each wall
///   mean_stress  the stress recorded, against that of the forces recomputed, in units of the mean stress
///   stability    number of negative eigenvalues of the stiffness matrix, see Stability
///   boundary_balance  the forces across the faces of the cell, and on walls, over their areas, against the
///                     stress (stress)
///   recorded     number of residuals, eigenvalue counts and flags recorded that are not those found
/// Geometry, law and mean stress are held to what rounding of the positions leaves open, the boundary to what
/// net forces within their tolerance do.
template <int Dim>
std::vector<Criterion> verify_equilibrium(const State<Dim>& state);

}  // namespace floc
