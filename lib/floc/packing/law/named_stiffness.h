#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Stiffnesses named for the contacts of rigid grains, which have none of their own (force/length).
struct NamedStiffness {
  double normal = 0.0;      ///< K_N of each contact point, > 0
  double tangential = 0.0;  ///< K_T of each contact point, >= 0; 0 if there is no friction
};

/// Returns a packing of rigid grains as one of linear springs: the same positions and forces, with these stiffnesses in all
/// contact points and in the law. Positions and forces do not determine the stiffnesses.
/// @throws InputError if the contacts are not rigid, or if K_T does not go with the friction of the law
template <int Dim>
Packing<Dim> with_named_stiffness(Packing<Dim> packing, const NamedStiffness& named);

}  // namespace floc
