#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Two grains whose surfaces, or those of their images, are close: a contact of theirs, or a place for one.
template <int Dim>
struct NeighborPair {
  int i;
  int j;                ///< >= i; equal for a grain and its own image
  Vec<Dim, int> image;  ///< branch = x[j] + image * cell.matrix - x[i]
  int key = 0;          ///< tells several contacts of one pair and image apart

  bool operator==(const NeighborPair&) const = default;
};

/// Every pair of surfaces closer than `gap`, each once, sorted by (i, j, image). Works for any lattice: a small
/// cell gives several images of one pair, and a grain's own images (one of each opposite two).
///
/// @param gap  largest distance of the surfaces (length), >= 0; pairs at exactly `gap` are left out
/// @throws InputError if a radius, position or the cell is not finite or the cell has no volume; if a grain
/// lies more than 1e9 cells away; if the search would take for ever, with a grain many cells wide or very many
/// grains beside a very large one; or if there are more than 1000 pairs per grain.
template <int Dim>
std::vector<NeighborPair<Dim>> find_pairs(const Cell<Dim>& cell, const Grains<Dim>& grains, double gap);

/// Every grain and wall whose surfaces are closer than `gap`, sorted by (i, j): i is the grain, j the number of
/// the wall among the walls. A grain beyond a wall counts as close to it.
template <int Dim>
std::vector<NeighborPair<Dim>> find_wall_pairs(const std::vector<Wall<Dim>>& walls, const Grains<Dim>& grains,
                                               double gap);

}  // namespace floc
