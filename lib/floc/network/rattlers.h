#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Grains that carry nothing, one entry a grain (docs/physics.md, "Coordination and rattlers").
///
/// With adhesion: a grain without any interaction; one held by a contact of zero force is no rattler.
/// Without: a grain none of whose contacts carries more than `smallest_force`, or that touches one grain only,
/// found by removing such grains until none is left. A packing that carries no force at all says nothing about
/// which grains would, so there only grains without contact count.
///
/// @param smallest_force  (force), >= 0
template <int Dim>
std::vector<bool> find_rattlers(const Packing<Dim>& packing, double smallest_force);

}  // namespace floc
