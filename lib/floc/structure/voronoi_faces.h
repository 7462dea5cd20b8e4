#pragma once

#include <vector>

#include "floc/base/vec.h"
#include "floc/geometry/cell.h"

namespace floc {

/// Face between the Voronoi cells of two points, with the branch vector between the points, which is a bond of the
/// Delaunay network.
struct VoronoiFace {
  int i, j;           ///< indices of the two points, i <= j
  Vec<3, int> image;  ///< periodic image of point j: branch = point[j] + image * cell.matrix - point[i]
  Vec<3> branch;      ///< vector from point i to the image of point j (length)
  Vec<3> centre;      ///< centre of area of the face, relative to point i (length)
  double area;        ///< area of the face (length^2)
};

struct VoronoiFaces {
  /// Volume of the Voronoi cell of each point (length^3). The volumes add up to the volume of the periodic cell.
  std::vector<double> volume;
  std::vector<VoronoiFace> faces;  ///< all faces, each once, sorted by (i, j, image)
};

/// Computes the volumes and faces of the Voronoi tessellation of points in a periodic cell.
/// @pre No two points coincide.
VoronoiFaces voronoi_faces(const Cell<3>& cell, const std::vector<Vec<3>>& points);

}  // namespace floc
