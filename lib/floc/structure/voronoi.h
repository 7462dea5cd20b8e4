#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// A ball in the voids of a packing of spheres that touches the spheres around it.
struct VoidBall {
  Vec<3> centre = Vec<3>::Zero();  ///< inside the cell (length)
  double radius = 0.0;             ///< (length), > 0
};

/// The radical Voronoi tessellation of a packing of spheres (docs/physics.md, "Structure"): the cell of a
/// sphere holds the points whose tangent to it is shorter than to any other.
struct VoronoiTessellation {
  std::vector<double> volume;          ///< volume of the cell of each grain, 0 where others cover it
  std::vector<double> solid_fraction;  ///< volume of each grain over that of its cell, 0 where there is none
  /// A ball around each vertex of the tessellation, up to the nearest surface; none where the vertex is inside
  /// a grain. For equal spheres these are the balls that four spheres touch.
  std::vector<VoidBall> voids;
};

/// Computes the tessellation, whose volumes add up to that of the cell. Vertices closer than 1e-6 largest
/// diameters are merged, such as those of crystals in which more than four spheres meet.
/// @pre the packing has grains and no walls
VoronoiTessellation voronoi_tessellation(const Packing<3>& packing);

}  // namespace floc
