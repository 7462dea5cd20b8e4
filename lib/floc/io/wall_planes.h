#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// A wall of another program: a plane perpendicular to an axis.
struct WallPlane {
  std::string place;  ///< place of the plane in its file, for messages
  int axis = 0;
  double position = 0.0;  ///< position of the plane on the axis normal to it (length)
  /// -1: the grains lie above the plane, 1: below; absent: the positions of the grains decide
  std::optional<int> side;
  /// Lowest and highest corner (length) of a plane of finite size; absent: the plane is infinite.
  std::optional<std::array<Eigen::Vector3d, 2>> corners;
};

/// Walls and gravity in a file of another program.
struct ListedWalls {
  std::vector<WallPlane> planes;
  std::optional<Eigen::Vector3d> gravity;  ///< acceleration due to gravity (length/time^2)
  std::vector<std::string> doubts;         ///< sentences for the user about commands that may change the walls
};

/// Reads the triangles of an STL file as planes.
/// @param scale, shift  factor by which the coordinates in the file are multiplied, and displacement (length) that is
/// added afterwards
/// @throws InputError for a triangle that is not perpendicular to an axis
std::vector<WallPlane> planes_of_mesh(const std::string& path, double scale = 1.0,
                                      const Eigen::Vector3d& shift = Eigen::Vector3d::Zero());

/// Reads the walls of a file. If the name ends in .stl, the file is an STL file, else an input script of LAMMPS or
/// LIGGGHTS.
/// @throws InputError under the conditions of planes_of_mesh() and walls_of_script()
ListedWalls read_wall_file(const std::string& path);

/// Returns the ends of the axes, with walls at the ends where planes lie. A plane without a side is a lower end if the
/// mean of the centres of the grains is above the plane, else an upper end. A plane of finite size is left out if no
/// grain lies directly above or below it. If several planes lie at the same end, the innermost is used.
std::vector<ListedEnds> ends_of_planes(const std::vector<WallPlane>& planes,
                                       const std::vector<ListedGrain>& grains, int n_axes);

}  // namespace floc
