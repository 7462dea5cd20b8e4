#pragma once

#include <cstdint>
#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Vertices of the Voronoi cells of random points in a periodic unit box, about their points. Cells that
/// rounding leaves open are empty.
///
/// @param n        number of points, >= 8
/// @param relaxed  number of times that all points go to the centres of mass of their cells (Lloyd)
template <int Dim>
std::vector<std::vector<Vec<Dim>>> voronoi_cells(int n, int relaxed, std::uint64_t seed);

}  // namespace floc
