#pragma once

#include <optional>

#include "floc/packing/packing.h"

namespace floc {

/// The pair of grains of a packing whose surfaces are nearest to each other. The second grain may be a periodic image
/// of the first.
struct NearestPair {
  int i = 0, j = 0;
  double gap = 0.0;  ///< distance between the two surfaces (length); negative if they overlap
};

/// Finds the pair of grains whose surfaces are nearest to each other.
/// @return the nearest pair; no value if all gaps are wider than about 1000 times the largest diameter
template <int Dim>
std::optional<NearestPair> nearest_pair(const Packing<Dim>& packing);

}  // namespace floc
