#pragma once

#include <cstdint>
#include <vector>

#include "floc/base/range.h"
#include "floc/packing/packing.h"

namespace floc {

/// Pair correlation g(r) of the centres: pairs at a distance in [b, b + 1) * width, over the number that N/V of
/// independent grains would give. All periodic images count, of any lattice and to any distance.
///
/// Between walls only grains no nearer to a wall than the largest distance count, as these see all their
/// neighbours, and g is relative to their own number density; 0 where there are none.
struct PairCorrelation {
  double width = 0.0;     ///< width of a bin (length)
  std::vector<double> g;  ///< g(r), bin by bin from r = 0
  /// Pairs in each bin; a pair and an image of it are two. Between walls, one for each of its grains that is
  /// away from the walls.
  std::vector<std::int64_t> n_pairs;

  double middle(int b) const { return (b + 0.5) * width; }
};

/// Largest distance of g(r), in largest diameters: at 1000 of them a packing of disks has three million neighbours for
/// each grain.
inline constexpr NumberRange kPairReach{.least = 0.0, .most = 1000.0, .without_least = true};
inline constexpr double kMostPairs = 2.5e8;  ///< largest number of pairs counted at once; they take 5 GB

/// Computes g(r) of a packing.
/// @param reach  largest distance (length), > 0   @param n_bins  >= 1
/// @throws InputError for other numbers, and where about kMostPairs pairs or more would be counted
template <int Dim>
PairCorrelation pair_correlation(const Packing<Dim>& packing, double reach, int n_bins);

}  // namespace floc
