#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Finds the rattlers, grains that carry no force (docs/physics.md, "Coordination and rattlers").
///
/// With adhesion or bonds (Contact::bonded), rattlers are the grains without any contact or attraction; a grain with a
/// contact is not a rattler, even if the force of the contact is zero, since the contact may pull.
///
/// Without adhesion and bonds, a grain is a rattler if it has fewer than two contacts, or if the normal force of none
/// of its contacts exceeds `smallest_force`. Rattlers are removed together with their contacts, and the search is
/// repeated until it finds no further rattler. If no contact of the packing carries a force, only grains without
/// contacts are rattlers.
///
/// @param smallest_force  largest normal force that counts as zero (force), >= 0
/// @return for each grain, whether it is a rattler
/// @throws InputError if `smallest_force` is negative or not finite
template <int Dim>
std::vector<bool> find_rattlers(const Packing<Dim>& packing, double smallest_force);

}  // namespace floc
