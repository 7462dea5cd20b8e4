#pragma once

#include <vector>

#include "floc/neighbors/pairs.h"

namespace floc {

/// Pairs of surfaces closer than the range of the law, in the order of contacts: pairs of grains, and pairs of
/// grains with walls. The indices of walls follow those of the grains.
/// @throws InputError as find_pairs()
template <int Dim>
std::vector<NeighborPair<Dim>> interacting_pairs(const Packing<Dim>& packing);

}  // namespace floc
