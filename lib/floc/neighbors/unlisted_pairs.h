#pragma once

#include <vector>

#include "floc/neighbors/pairs.h"

namespace floc {

/// Returns the elements of `pairs` that are not among the contacts of a packing. These pairs are returned as contacts
/// in which only the members i, j and image are set.
/// @param packing  packing; its contacts, and the two grains of each contact, may be in any order
/// @param pairs  pairs in canonical form (i <= j), sorted by (i, j, image), like those that find_pairs() and
/// interacting_pairs() return
template <int Dim>
std::vector<Contact<Dim>> unlisted_pairs(const Packing<Dim>& packing,
                                         const std::vector<NeighborPair<Dim>>& pairs);

}  // namespace floc
