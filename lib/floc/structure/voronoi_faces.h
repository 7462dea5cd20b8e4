#pragma once

#include <vector>

#include "floc/base/vec.h"
#include "floc/geometry/cell.h"

namespace floc {

/// The face that the Voronoi cells of two points share: the bond of the Delaunay network that crosses it.
struct VoronoiFace {
  int i, j;           ///< points, i <= j
  Vec<3, int> image;  ///< branch = point[j] + image * cell.matrix - point[i]
  Vec<3> branch;      ///< (length)
  Vec<3> centre;      ///< centre of area, from point i (length)
  double area;        ///< (length^2)
};

struct VoronoiFaces {
  std::vector<double> volume;      ///< volume of the cell of each point; the cells fill the periodic cell
  std::vector<VoronoiFace> faces;  ///< each once, sorted by (i, j, image)
};

/// Computes the Voronoi tessellation of points in a periodic cell. @pre no two points are the same
VoronoiFaces voronoi_faces(const Cell<3>& cell, const std::vector<Vec<3>>& points);

}  // namespace floc
