#pragma once

#include <vector>

#include "floc/neighbors/pairs.h"

namespace floc {

/// Returns the members of `pairs` that are not among the contacts of a packing, as contacts whose members i, j and
/// image are set and whose other members have their defaults.
/// @param pairs  pairs in canonical form (i <= j) and sorted, like those that find_pairs() and interacting_pairs()
/// return; the contacts of the packing may be in any order and form
template <int Dim>
std::vector<Contact<Dim>> unlisted_pairs(const Packing<Dim>& packing,
                                         const std::vector<NeighborPair<Dim>>& pairs);

}  // namespace floc
