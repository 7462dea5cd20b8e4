#pragma once

#include <cstdint>
#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Returns the vertices of the Voronoi cells of random points in a periodic unit box, relative to these points.
/// Cells that are not closed because of rounding errors are empty.
///
/// @param n  number of points, >= 8
/// @param relaxed  number of times that all points are moved to the centres of mass of their cells (Lloyd's
/// algorithm)
template <int Dim>
std::vector<std::vector<Vec<Dim>>> voronoi_cells(int n, int relaxed, std::uint64_t seed);

}  // namespace floc
