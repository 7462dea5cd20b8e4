#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/packing/state.h"

namespace floc {

/// One condition that an equilibrium must satisfy. It is tested on the positions of the grains, the elongations of the
/// springs and the contact law of a state, without its stored forces.
struct Criterion {
  const char* name;
  std::optional<double> value;  ///< value found in the state; absent if it could not be tested
  double limit;                 ///< largest allowed value
  bool holds;                   ///< whether the criterion is met
  /// Description of a violation: the grains or contacts that violate the criterion, worst first. If the criterion could
  /// not be tested fully, the reason. Otherwise empty.
  std::string where;
  bool by_value = true;  ///< whether a violation can be seen by comparing `value` with `limit`
};

/// Recomputes the contacts of a state from positions, springs and contact law, and tests whether the recomputed
/// packing is in equilibrium. The criteria, with the unit of their values, are
///   geometry     largest difference of stored gaps and normals of contacts from the positions (length)
///   list         number of interactions within the range of the law that are missing in the contact list, and of
///                listed contacts that do not interact
///   law          largest difference of stored forces and moments from the law and the springs (force); stored
///                stiffnesses and the distinction of touching and distant contacts are tested too
///   force, moment, stress, energy   the four residuals, which must be below the tolerances recorded in the state;
///                with walls, the stress is the pressure on each wall
///   mean_stress  difference of the recorded stress from the stress of the recomputed forces, over the mean stress
///   stability    number of negative eigenvalues of the stiffness matrix, see Stability
///   boundary_balance  difference of the stress from the forces across the faces of the cell, and on walls, over the
///                areas of these faces (stress)
///   length       largest relative difference of the lengths of axes from the imposed lengths; omitted if no length
///                is imposed
///   liquid       number of liquid bridges that would change, which must be the recorded number
///   recorded     number of recorded residuals, worst grains, eigenvalue counts, flags and forces on walls that differ
///                from the values found
/// Geometry, law and mean stress may differ by the errors that rounding of the positions causes, and the boundary
/// balance by the effect of net forces within their tolerance.
template <int Dim>
std::vector<Criterion> verify_equilibrium(const State<Dim>& state);

}  // namespace floc
