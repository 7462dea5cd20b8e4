#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Replaces the contacts of a packing by all interactions that its geometry and law give: every pair of
/// surfaces that overlap or are closer than the law's range, springs at rest. Liquid that the law
/// has is shared out between them (spread_liquid()).
/// @throws InputError as find_pairs(), if two grains have the same centre, or if a grain has more than 100
/// contacts in the mean (10 000 in all in a small packing).
template <int Dim>
void find_contacts(Packing<Dim>& packing);

}  // namespace floc
