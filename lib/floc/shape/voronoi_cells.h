#pragma once

#include <cstdint>
#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Returns the vertices of the Voronoi cells of random points in a periodic unit box. The coordinates of the vertices
/// are relative to the point of the cell. If rounding errors leave a cell open, the list of its vertices is empty.
///
/// @param n  number of points, >= 8
/// @param relaxed  number of times that each point is moved to the centre of mass of its cell (Lloyd's algorithm)
template <int Dim>
std::vector<std::vector<Vec<Dim>>> voronoi_cells(int n, int relaxed, std::uint64_t seed);

}  // namespace floc
