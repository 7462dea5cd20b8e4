#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Pair of grains whose surfaces, or those of their images, are close: a contact, or a place where one may
/// form.
template <int Dim>
struct NeighborPair {
  int i;
  int j;                ///< >= i; equal for a grain and its own image
  Vec<Dim, int> image;  ///< branch = x[j] + image * cell.matrix - x[i]
  int key = 0;          ///< distinguishes several contacts of one pair and image

  bool operator==(const NeighborPair&) const = default;
};

/// Finds every pair of surfaces closer than `gap`, each once, sorted by (i, j, image). The lattice may be of
/// any shape: in a small cell a pair may appear with several images, and a grain with its own images (one of
/// each opposite two).
///
/// @param gap  largest distance of the surfaces (length), >= 0; pairs at exactly `gap` are left out
/// @throws InputError if a radius, position or the cell is not finite or the cell has no volume; if a grain
/// lies more than 1e9 cells away; if the search would take too long, with a grain many cells wide or very many
/// grains beside a very large one; or if there are more than 10 000 pairs plus 1000 per grain.
template <int Dim>
std::vector<NeighborPair<Dim>> find_pairs(const Cell<Dim>& cell, const Grains<Dim>& grains, double gap);

/// Finds every grain and wall whose surfaces are closer than `gap` (length), sorted by (i, j): i is the grain,
/// j the index of the wall among the walls. A grain beyond a wall counts as close to it.
template <int Dim>
std::vector<NeighborPair<Dim>> find_wall_pairs(const std::vector<Wall<Dim>>& walls, const Grains<Dim>& grains,
                                               double gap);

}  // namespace floc
