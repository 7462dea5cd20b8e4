#pragma once

#include <vector>

#include "floc/neighbors/pairs.h"

namespace floc {

/// Returns those members of `pairs` that are not among the contacts of a packing. They are returned as contacts whose
/// members i, j and image are set; the other members have their default values.
/// @param packing  packing, whose contacts may be in any order, as may the two grains of each contact
/// @param pairs  pairs in canonical form (i <= j), sorted by (i, j, image), as find_pairs() and interacting_pairs()
/// return them
template <int Dim>
std::vector<Contact<Dim>> unlisted_pairs(const Packing<Dim>& packing,
                                         const std::vector<NeighborPair<Dim>>& pairs);

}  // namespace floc
