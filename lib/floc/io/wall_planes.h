#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// A plane across an axis that another program has as a wall.
struct WallPlane {
  std::string place;  ///< place of the plane in its file, for messages
  int axis = 0;
  double position = 0.0;    ///< place of the plane on its axis (length)
  std::optional<int> side;  ///< -1: grains lie above it, 1: below; absent: it follows from the grains
  /// Lowest and highest corner of a plane that ends somewhere (length); absent: it does not end.
  std::optional<std::array<Eigen::Vector3d, 2>> corners;
};

/// Walls and weight that the file of another program gives.
struct ListedWalls {
  std::vector<WallPlane> planes;
  std::optional<Eigen::Vector3d> gravity;  ///< acceleration due to gravity (length/time^2)
};

/// Reads the triangles of an STL file as planes.
/// @param scale, shift  factor and displacement (length) that are applied to the coordinates of the file, in this order
/// @throws InputError for a triangle that lies across no axis
std::vector<WallPlane> planes_of_mesh(const std::string& path, double scale = 1.0,
                                      const Eigen::Vector3d& shift = Eigen::Vector3d::Zero());

/// Reads the walls of a file, which is an STL file, by its name, or an input script of LAMMPS or LIGGGHTS.
/// @throws InputError under the conditions of planes_of_mesh() and walls_of_script()
ListedWalls read_wall_file(const std::string& path);

/// Returns the ends of the axes that planes give. A plane without a side is the lower end if the mean of the grains'
/// centres is above it. Planes that no grain faces are left out. Of several planes at an end the innermost counts.
std::vector<ListedEnds> ends_of_planes(const std::vector<WallPlane>& planes,
                                       const std::vector<ListedGrain>& grains, int n_axes);

}  // namespace floc
