#pragma once

#include <cstdint>
#include <vector>

#include "floc/base/range.h"
#include "floc/packing/packing.h"

namespace floc {

/// Pair correlation g(r) of the centres of grains: the number of pairs with a distance r in a bin, divided by the
/// number expected in this bin if the grains were at independent random places. Bin b begins at r = b * width. All
/// periodic images are counted, for any lattice and any distance.
///
/// Between walls, only neighbours of inner grains are counted. An inner grain is at least as far from every wall as the
/// largest distance r, so that all its neighbours are in the packing. The expected number follows from the number
/// density of the inner grains. g(r) is 0 if there are no inner grains.
struct PairCorrelation {
  double width = 0.0;     ///< width of a bin (length)
  std::vector<double> g;  ///< pair correlation g(r) of each bin, from r = 0
  /// Number of pairs in each bin; each periodic image of a neighbour counts as a pair. Between walls, a pair of two
  /// inner grains counts twice.
  std::vector<std::int64_t> n_pairs;

  double middle(int b) const { return (b + 0.5) * width; }
};

/// Allowed values of the largest distance r of g(r), in units of the largest diameter. At a distance of up to 1000
/// diameters, each disk of a packing has about three million neighbours.
inline constexpr NumberRange kPairReach{.least = 0.0, .most = 1000.0, .without_least = true};
/// Computes the pair correlation g(r) of a packing.
/// @param reach   largest distance (length), > 0
/// @param n_bins  number of bins, >= 1
/// @throws InputError for other values, or if more than about kMostPairsInMemory pairs would be counted
template <int Dim>
PairCorrelation pair_correlation(const Packing<Dim>& packing, double reach, int n_bins);

}  // namespace floc
