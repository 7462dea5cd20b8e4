#pragma once

#include <vector>

#include "floc/neighbors/pairs.h"

namespace floc {

/// Pairs closer than the range of the law, sorted as contacts are: pairs of grains, and of grains with walls,
/// whose numbers follow those of the grains.
/// @throws InputError as find_pairs()
template <int Dim>
std::vector<NeighborPair<Dim>> interacting_pairs(const Packing<Dim>& packing);

}  // namespace floc
