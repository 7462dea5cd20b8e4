#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Replaces the contacts of a packing by all pairs whose surfaces overlap or are closer than the range of the contact
/// law. The springs of the new contacts are unloaded. If the contact law has liquid bridges, the liquid is distributed
/// over the pairs that are close enough for a bridge (spread_liquid()).
/// @throws InputError if find_pairs() throws it; if two grains in contact have the same centre, or the centre of a
/// grain is on or beyond a wall; or if the number of contacts exceeds 10 000 plus 100 per grain
template <int Dim>
void find_contacts(Packing<Dim>& packing);

}  // namespace floc
