#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Replaces the contacts of a packing by all interactions that follow from its geometry and law: every pair of surfaces
/// that overlap or are closer than the range of the contact law. The springs of all contacts are unloaded. If the
/// contact law has liquid bridges, the liquid is distributed over the pairs that are close enough for a bridge
/// (spread_liquid()).
/// @throws InputError if find_pairs() throws it; if two grains have the same centre, or a grain has its centre on or
/// beyond a wall; or if there are more than 10 000 contacts plus 100 per grain.
template <int Dim>
void find_contacts(Packing<Dim>& packing);

}  // namespace floc
