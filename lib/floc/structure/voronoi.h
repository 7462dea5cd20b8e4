#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Ball in the void space of a packing of spheres. The ball touches the spheres around it.
struct VoidBall {
  Vec<3> centre = Vec<3>::Zero();  ///< centre of the ball, inside the cell (length)
  double radius = 0.0;             ///< radius of the ball (length), > 0
};

/// Radical Voronoi tessellation of a packing of spheres (docs/physics.md, "Structure"). A point belongs to the Voronoi
/// cell of the sphere to which the tangent from the point is shortest.
struct VoronoiTessellation {
  /// Volume of the Voronoi cell of each grain (length^3); 0 if the grain has no cell.
  std::vector<double> volume;
  /// Volume of each grain divided by the volume of its Voronoi cell; 0 if the grain has no cell.
  std::vector<double> solid_fraction;
  /// Balls around the vertices of the tessellation. Each ball extends to the nearest surface of a grain. Vertices
  /// inside a grain have no ball. In a packing of equal spheres, each ball touches four or more spheres.
  std::vector<VoidBall> voids;
};

/// Computes the radical Voronoi tessellation. The volumes of the Voronoi cells add up to the volume of the periodic
/// cell. Vertices whose distance is below 1e-6 times the largest diameter are merged. This is necessary for crystals,
/// in which more than four cells meet at a vertex.
/// @pre the packing has grains and no walls
VoronoiTessellation voronoi_tessellation(const Packing<3>& packing);

}  // namespace floc
