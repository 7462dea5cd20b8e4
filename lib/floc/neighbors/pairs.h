#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Pair of grains whose surfaces touch or are so close that they may come into contact. The second grain may be a
/// periodic image.
template <int Dim>
struct NeighborPair {
  int i;
  int j;  ///< index of the second grain, >= i; equal to i for a grain and its own image
  /// Periodic image of grain j, as numbers of lattice vectors. If x are the positions of the grains, the vector from
  /// the centre of i to the centre of this image is x[j] + image * cell.matrix - x[i].
  Vec<Dim, int> image;
  int key = 0;  ///< number that distinguishes several contacts between the same two surfaces

  bool operator==(const NeighborPair&) const = default;
};

/// Finds every pair of grains whose surfaces are closer than `gap`. Each pair appears once; the pairs are sorted by (i,
/// j, image). The lattice vectors may have any lengths and directions. In a small cell, two grains may form several
/// pairs with different periodic images, and a grain may form pairs with its own images. The pairs of a grain with two
/// opposite images of itself count as one pair.
///
/// @param gap  two grains form a pair if the distance (length) between their surfaces is below this value, >= 0
/// @param most_per_grain  limit of the number of pairs per grain. Grains that touch have a few tens of neighbours even
/// if sizes differ much, so that with the default a radius or the cell is wrong if there are more.
/// @throws InputError if a radius, a position or the cell is not finite, or the cell has no volume; if a grain lies
/// more than 1e9 cells away from the cell; if the search would take too long, for example because a grain is many cells
/// wide, or because many small grains are mixed with a very large grain; or if there are more than
/// 10 000 pairs plus `most_per_grain` per grain
template <int Dim>
std::vector<NeighborPair<Dim>> find_pairs(const Cell<Dim>& cell, const Grains<Dim>& grains, double gap,
                                          double most_per_grain = 1000.0);

/// Largest number of pairs whose search fits into memory: they need 5 GB.
inline constexpr double kMostPairsInMemory = 2.5e8;

/// Returns the limit `most_per_grain` of find_pairs() for wide gaps, across which a grain may have thousands of
/// neighbours: the number of pairs per grain that fits into memory.
double most_pairs_in_memory(int n_grains);

/// Finds every pair of a grain and a wall whose surfaces are closer than `gap` (length). The pairs are sorted by
/// (i, j), where i is the index of the grain and j the index of the wall in `walls`. A grain whose centre lies beyond a
/// wall is paired with that wall, too.
template <int Dim>
std::vector<NeighborPair<Dim>> find_wall_pairs(const std::vector<Wall<Dim>>& walls, const Grains<Dim>& grains,
                                               double gap);

}  // namespace floc
