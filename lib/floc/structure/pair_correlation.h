#pragma once

#include <cstdint>
#include <vector>

#include "floc/base/range.h"
#include "floc/packing/packing.h"

namespace floc {

/// Pair correlation g(r) of the centres of grains: number of pairs whose distance r is in a bin, divided by the number
/// of such pairs that is expected for independent grains of the same number density. Bin b extends from b * width to (b
/// + 1) * width. All periodic images are counted, for any lattice and any distance.
///
/// Between walls, only grains that are at least the largest distance of g(r) away from every wall are counted, because
/// all neighbours of these grains are in the packing. The number density in g(r) is then that of the counted grains.
/// g(r) is 0 if no grain is counted.
struct PairCorrelation {
  double width = 0.0;     ///< width of a bin (length)
  std::vector<double> g;  ///< pair correlation g(r) of each bin, from r = 0
  /// Number of pairs in each bin; periodic images of a pair at other distances count separately. Between walls, a pair
  /// counts once for each of its grains that is far enough from the walls.
  std::vector<std::int64_t> n_pairs;

  double middle(int b) const { return (b + 0.5) * width; }
};

/// Allowed values of the largest distance r of g(r), in units of the largest diameter. At a distance of up to 1000
/// diameters, each disk of a packing has about three million neighbours.
inline constexpr NumberRange kPairReach{.least = 0.0, .most = 1000.0, .without_least = true};
/// Largest number of pairs that may be counted for g(r). This number of pairs needs 5 GB of memory.
inline constexpr double kMostPairs = 2.5e8;

/// Computes the pair correlation g(r) of a packing.
/// @param reach   largest distance (length), > 0
/// @param n_bins  number of bins, >= 1
/// @throws InputError for other values, or if about kMostPairs pairs or more would be counted
template <int Dim>
PairCorrelation pair_correlation(const Packing<Dim>& packing, double reach, int n_bins);

}  // namespace floc
