#pragma once

#include <optional>

#include "floc/packing/packing.h"

namespace floc {

/// The pair of grains whose surfaces are nearest to each other.
struct NearestPair {
  int i = 0, j = 0;
  double gap = 0.0;  ///< (length), negative where they overlap
};

/// @return nothing where the search for a neighbour ends in vain, as with grains far smaller than the cell
template <int Dim>
std::optional<NearestPair> nearest_pair(const Packing<Dim>& packing);

}  // namespace floc
