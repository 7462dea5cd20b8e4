#pragma once

#include <optional>

#include "floc/packing/packing.h"

namespace floc {

/// Pair of grains of a packing whose surfaces are nearest to each other. It may consist of a grain and its own periodic
/// image.
struct NearestPair {
  int i = 0, j = 0;
  double gap = 0.0;  ///< distance between the two surfaces (length); negative if they overlap
};

/// Finds the pair of grains whose surfaces are nearest to each other.
/// @return the nearest pair; no value if all gaps are wider than about a thousand largest diameters
template <int Dim>
std::optional<NearestPair> nearest_pair(const Packing<Dim>& packing);

}  // namespace floc
