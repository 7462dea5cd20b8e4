#pragma once

#include <cstdint>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Pair correlation g(r) of the centres: pairs at a distance in [b, b + 1) * width, over the number that N/V of
/// independent grains would give. All periodic images count, of any lattice and to any distance.
///
/// Between walls only grains no nearer to a wall than the largest distance count, as these see all their
/// neighbours, and g is relative to their own number density; 0 where there are none.
struct PairCorrelation {
  double width = 0.0;                 ///< of a bin (length)
  std::vector<double> g;              ///< g(r), bin by bin from r = 0
  std::vector<std::int64_t> n_pairs;  ///< in each bin; a pair and an image of it are two. Between walls
                                      ///< one for each grain of it away from them

  double middle(int b) const { return (b + 0.5) * width; }
};

/// @param reach  largest distance (length), > 0   @param n_bins  >= 1
template <int Dim>
PairCorrelation pair_correlation(const Packing<Dim>& packing, double reach, int n_bins);

}  // namespace floc
