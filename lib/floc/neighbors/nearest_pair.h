#pragma once

#include <optional>

#include "floc/packing/packing.h"

namespace floc {

/// Pair of grains whose surfaces are nearest to each other.
struct NearestPair {
  int i = 0, j = 0;
  double gap = 0.0;  ///< distance between the two surfaces (length); negative if they overlap
};

/// Finds the pair of grains whose surfaces are nearest to each other.
/// @return the pair; no value if the search finds no neighbour, for example if the grains are far smaller than the cell
template <int Dim>
std::optional<NearestPair> nearest_pair(const Packing<Dim>& packing);

}  // namespace floc
