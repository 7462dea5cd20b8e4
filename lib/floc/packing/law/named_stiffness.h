#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Stiffnesses that a user gives for the contacts of rigid grains, which have no stiffness of their own (force/length).
struct NamedStiffness {
  double normal = 0.0;      ///< normal stiffness K_N of each contact point, > 0
  double tangential = 0.0;  ///< tangential stiffness K_T of each contact point, >= 0; 0 if there is no friction
};

/// Returns a packing of linear springs with the positions and forces of a packing of rigid grains. Positions and forces
/// do not determine stiffnesses, so the given stiffnesses apply to all contact points and to the contact law.
/// @throws InputError if the contacts are not rigid, or if K_T is not compatible with the friction of the law
template <int Dim>
Packing<Dim> with_named_stiffness(Packing<Dim> packing, const NamedStiffness& named);

}  // namespace floc
