#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace floc {

/// One of the two ends of a packing along an axis: the lower end (side -1) or the upper end (side 1).
struct WallSide {
  int axis = 0;  ///< axis, counted from 0
  int side = -1;

  /// Name of the end in options, files and messages: "x-" is the lower end along x, "x+" the upper end.
  std::string name() const { return std::string(1, "xyz"[axis]) + (side < 0 ? "-" : "+"); }
  bool operator==(const WallSide&) const = default;
};

/// Reads the name of an end of an axis, such as "x-". @return nothing if `name` is not the name of an end
std::optional<WallSide> wall_side(const std::string& name);

/// Boundary along an axis that is not periodic. Each of the two ends of the axis has a wall or is open.
struct ListedEnds {
  int axis = 0;
  /// Position (length) of the wall at each end of the axis; empty if the end is open.
  std::optional<double> low, high;
  /// Mass of the wall at each end; infinite if forces do not move the wall.
  double low_mass = std::numeric_limits<double>::infinity(), high_mass = low_mass;
};

/// Data in a file of another program about the space that a packing fills: its cell, its boundary, its dimension and
/// gravity.
struct ListedSpace {
  std::string place;  ///< place of these data in the file, for messages
  /// Three lattice vectors with three components each (length). Empty if the file gives no cell.
  std::vector<std::vector<double>> cell;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< corner from which the lattice vectors start (length)
  bool positive_sides = false;  ///< whether the diagonal elements of `cell` must be positive, as in LAMMPS
  /// Whether the packing is periodic along each lattice vector. Empty if the file does not contain this information.
  std::vector<bool> periodic;
  /// Text in the file that says which axes are not periodic, such as pbc="F F F"; for messages.
  std::string boundary;
  /// Ends of axes that are not periodic, if the file gives them. An axis that is neither periodic nor in this list has
  /// two open ends.
  std::vector<ListedEnds> ends;
  /// Whether the positions of the walls are exact, as in files of floc. If true, an overlap of a grain with a wall does
  /// not indicate an error.
  bool exact_walls = false;
  std::optional<int> dimension;  ///< 2 or 3; absent if the file does not give it
  /// Whether all grains lie halfway between the lower and the upper face of the cell across z, as LAMMPS requires in
  /// two dimensions.
  bool mid_plane = false;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< acceleration due to gravity (length/time^2)
};

/// Returns the ends of an axis of `space`. If the axis is not in `space.ends` yet, adds it with open ends.
ListedEnds& ends_along(int axis, ListedSpace& space);

/// Adds a wall at a position on its axis. The other end of the axis is open unless it gets a wall, too.
void add_wall(const WallSide& wall, double position, ListedSpace& space);

/// Adds a wall at a face of the cell of `space`. The other end of the axis is open unless it gets a wall, too.
/// @pre the cell is given
void add_wall_at_face(const WallSide& wall, ListedSpace& space);

/// The entries of the option `--walls`: axes, for parse_walls(), and names of files of other programs that describe
/// walls.
struct WallOption {
  std::string axes;
  std::vector<std::string> files;
};

/// Separates the entries of the option `--walls` into axes and names of files. An entry is the name of a file if it
/// does not describe an axis and either contains a dot or is the path of an existing file.
WallOption split_walls(const std::string& text);

/// Reads the axes in the option `--walls`. The text lists axes that are not periodic, separated by commas. Each entry
/// is one of
///
///   x         walls at both faces of the box across x
///   x-, x+    a wall at the lower or upper face across x; the other end is open
///   x=0:10    walls at x = 0 and x = 10; an end without a number is open
///
/// @param space  space that contains the box; entries such as "x" refer to faces of this box
/// @param n_axes  dimension of the packing
/// @throws InputError for an entry of another form, an axis given twice, a face of a box that is not given, or walls in
/// the wrong order
std::vector<ListedEnds> parse_walls(const std::string& text, const ListedSpace& space, int n_axes);

}  // namespace floc
