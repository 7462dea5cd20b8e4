#pragma once

#include <vector>

#include "floc/neighbors/pairs.h"

namespace floc {

/// Returns the pairs whose surfaces are closer than the range of the contact law: pairs of two grains, and pairs of a
/// grain and a wall. The pairs are sorted by (i, j, image). In a pair with a wall, j is the number of grains plus the
/// index of the wall among the walls of the packing.
/// @throws InputError if find_pairs() throws it
template <int Dim>
std::vector<NeighborPair<Dim>> interacting_pairs(const Packing<Dim>& packing);

}  // namespace floc
