#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Finds the rattlers, grains that carry no force (docs/physics.md, "Coordination and rattlers").
///
/// With adhesion, rattlers are grains without any interaction; a grain held by a contact of zero force is none.
/// Without adhesion they are grains none of whose contacts carries more than `smallest_force`, or that touch
/// one grain only; such grains are removed until none is left. In a packing that carries no force at all, where
/// this criterion cannot tell rattlers from other grains, only grains without contact count.
///
/// @param smallest_force  largest normal force that counts as none (force), >= 0
/// @return one entry per grain: whether it is a rattler
/// @throws InputError for another force
template <int Dim>
std::vector<bool> find_rattlers(const Packing<Dim>& packing, double smallest_force);

}  // namespace floc
