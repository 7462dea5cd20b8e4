#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/packing/packing.h"

namespace floc {

/// Map of the solid fraction of a packing on a mesh. Mesh cells are parallelograms; their sides are the lattice vectors
/// divided by `size`. The value of a mesh cell is the share of its area that lies inside grains.
/// Mesh cell (k1, k2) has the index k1 * size[1] + k2.
struct CoverageMap {
  Vec<2, int> size = Vec<2, int>::Zero();  ///< number of mesh cells along each lattice vector
  std::vector<double> share;               ///< solid fraction of each mesh cell; overlaps count twice

  double operator()(int k1, int k2) const { return share[static_cast<std::size_t>(k1) * size[1] + k2]; }
};

/// Returns the area that a disk of radius R > 0 about the origin shares with a polygon (length^2).
/// @param corners  corners of the polygon, counter-clockwise (length); clockwise corners give the negative area
double disk_polygon_overlap(double R, const std::vector<Vec<2>>& corners);

/// Allowed number of mesh cells of a map along one lattice vector, and allowed total number of mesh cells.
inline constexpr WholeRange kMapSide{.least = 1, .most = 10000};
inline constexpr WholeRange kMapCells{.least = 1, .most = 10000000};

/// Computes a map of the solid fraction. The area that a disk shares with a mesh cell is computed in closed form, so
/// the value of every mesh cell is exact. The mean of the map is the solid fraction of the packing.
/// @param size  number of mesh cells along each lattice vector, >= 1
/// @throws InputError if a number is less than 1
CoverageMap coverage_map(const Packing<2>& packing, const Vec<2, int>& size);

}  // namespace floc
