#pragma once

#include <string>

#include "floc/packing/packing.h"

namespace floc {

/// Bodies of a stiffness: each contact point, or the contact of a pair of bodies, which may have several points.
enum class StiffnessPer { point, contact };

/// Returns the value for a keyword of `floc moduli --stiffness-per`: "point" or "contact".
/// @pre the keyword is valid
StiffnessPer stiffness_per(const std::string& keyword);

/// Stiffnesses that a user gives for the contacts of rigid grains, which have no stiffness of their own (force/length).
struct NamedStiffness {
  double normal = 0.0;      ///< normal stiffness K_N, > 0
  double tangential = 0.0;  ///< tangential stiffness K_T, >= 0; 0 if there is no friction
  /// Whether each contact point has these stiffnesses, or all points of a pair together. In the latter case the points of
  /// the pair have equal shares, whether they carry a force or not.
  StiffnessPer per = StiffnessPer::point;
};

/// Returns a packing of linear springs with the positions and forces of a packing of rigid grains. Positions and forces
/// do not determine stiffnesses, so the given stiffnesses apply to all contacts and to the contact law.
/// @throws InputError if the contacts are not rigid, or if K_T is not compatible with the friction of the law
template <int Dim>
Packing<Dim> with_named_stiffness(Packing<Dim> packing, const NamedStiffness& named);

}  // namespace floc
