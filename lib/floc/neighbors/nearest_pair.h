#pragma once

#include <optional>

#include "floc/packing/packing.h"

namespace floc {

/// Pair of grains whose surfaces are nearest to each other.
struct NearestPair {
  int i = 0, j = 0;
  double gap = 0.0;  ///< distance of the surfaces (length), negative where they overlap
};

/// Finds the pair of grains whose surfaces are nearest to each other.
/// @return the pair; absent where the search finds no neighbour, as with grains far smaller than the cell
template <int Dim>
std::optional<NearestPair> nearest_pair(const Packing<Dim>& packing);

}  // namespace floc
