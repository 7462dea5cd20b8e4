#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Replaces the contacts of a packing by all interactions that its geometry and law give: every pair of
/// surfaces that overlap or are closer than the law's range, with springs at rest. If the law has liquid, it is
/// shared out between them (spread_liquid()).
/// @throws InputError as find_pairs(), if two grains have the same centre, or if grains have more than 100
/// contacts on average (10 000 in all in a small packing).
template <int Dim>
void find_contacts(Packing<Dim>& packing);

}  // namespace floc
