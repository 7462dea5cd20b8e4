#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/packing/packing.h"

namespace floc {

/// Share of each cell of a regular mesh that grains cover. Mesh cells are parallelograms, the lattice vectors
/// divided by `size`; values of cell (k1, k2) are at k1 * size[1] + k2.
struct CoverageMap {
  Vec<2, int> size = Vec<2, int>::Zero();  ///< mesh cells along each lattice vector
  std::vector<double> share;               ///< local solid fraction; overlaps count twice

  double operator()(int k1, int k2) const { return share[static_cast<std::size_t>(k1) * size[1] + k2]; }
};

/// Returns the area that a disk of radius R > 0 about the origin shares with a polygon.
/// @param corners  counter-clockwise (length); clockwise ones give the negative area
double disk_polygon_overlap(double R, const std::vector<Vec<2>>& corners);

/// Ranges of the number of mesh cells of a map, along each lattice vector and in all.
inline constexpr WholeRange kMapSide{.least = 1, .most = 10000};
inline constexpr WholeRange kMapCells{.least = 1, .most = 10000000};

/// Computes a map of the solid fraction that is exact in every mesh cell: disks are cut along its edges in
/// closed form. The mean of the map is the solid fraction of the packing.
/// @param size  mesh cells along each lattice vector, >= 1   @throws InputError if it is less
CoverageMap coverage_map(const Packing<2>& packing, const Vec<2, int>& size);

}  // namespace floc
