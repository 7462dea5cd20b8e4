#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/packing/state.h"

namespace floc {

/// One condition that a state in equilibrium must satisfy. The condition is tested on forces that are recomputed from
/// the positions of the grains, the elongations of the springs and the contact law, and not on the stored forces. For
/// rigid contacts the stored forces are tested, because their forces do not follow from these data.
struct Criterion {
  const char* name;
  std::optional<double> value;  ///< value found in the state; absent if not tested
  double limit;                 ///< largest allowed value
  bool holds;                   ///< whether the criterion is met
  /// Text for messages. If the criterion is violated, the text lists the grains or contacts that violate it, worst
  /// first. If the criterion could not be tested fully, the text gives the reason. Otherwise it is empty.
  std::string where;
  /// Whether `value` exceeds `limit` if the criterion is violated. If false, `value` is within `limit`, and only
  /// `where` describes the violation.
  bool by_value = true;
};

/// Recomputes the contacts of a state from positions, springs and contact law, and tests whether the recomputed packing
/// is in equilibrium. The criteria, with the unit of their values, are
///   geometry     largest difference (length) between the stored geometry of a contact and the geometry that follows
///                from the positions: gap, normal and, for grains with corners, contact point
///   list         number of pairs that interact but are missing in the contact list, plus number of listed contacts
///                that do not interact
///   law          largest difference (force) between the stored forces and moments and the values that the law gives
///                for the springs; stored stiffnesses and the marks of contacts as touching or distant are tested too
///   force, moment, stress, energy   the four residuals, which must be below the tolerances recorded in the state;
///                with walls, the stress is the pressure on each wall
///   mean_stress  difference between the recorded stress and the stress of the recomputed forces, divided by the mean
///                stress
///   stability    number of negative eigenvalues of the stiffness matrix, see Stability
///   boundary_balance  difference (stress) between the stress of all contacts and the stress on the boundary, which is
///                the force across each face of the cell, or on each wall, divided by the area of the face
///   length       largest relative difference between lengths of axes and the imposed lengths; omitted if no length is
///                imposed
///   liquid       number of liquid bridges that would change if the liquid were distributed once more, which must be
///                the number recorded in the state
///   recorded     number of recorded residuals, worst grains, eigenvalue counts, flags and forces on walls that differ
///                from the values found
/// The criteria geometry, law and mean_stress accept differences that rounding of the positions causes. The criterion
/// boundary_balance accepts differences that net forces within their tolerance cause.
template <int Dim>
std::vector<Criterion> verify_equilibrium(const State<Dim>& state);

}  // namespace floc
