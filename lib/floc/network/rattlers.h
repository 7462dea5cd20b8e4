#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Grains that carry nothing, one entry per grain (docs/physics.md, "Coordination and rattlers").
///
/// With adhesion: grains without any interaction; a grain held by a contact of zero force is not a rattler.
/// Without: grains none of whose contacts carries more than `smallest_force`, or that touch one grain only,
/// found by removing such grains until none is left. A packing that carries no force at all does not tell which
/// grains would carry any, so in it only grains without contact count.
///
/// @param smallest_force  (force), >= 0; otherwise InputError
template <int Dim>
std::vector<bool> find_rattlers(const Packing<Dim>& packing, double smallest_force);

}  // namespace floc
