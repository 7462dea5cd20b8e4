#pragma once

#include <vector>

#include "floc/neighbors/pairs.h"

namespace floc {

/// Returns the members of `pairs` that are not among the contacts of a packing, as contacts of which only i, j
/// and image are set.
/// @param pairs  in canonical form and sorted, as find_pairs() and interacting_pairs() return them; the contacts
/// may be in any order and form
template <int Dim>
std::vector<Contact<Dim>> unlisted_pairs(const Packing<Dim>& packing,
                                         const std::vector<NeighborPair<Dim>>& pairs);

}  // namespace floc
