#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/io/listed_space.h"

namespace floc {

/// Access to the arrays of field data in a file of VTK (in any of the formats of VTK).
struct FieldArrays {
  std::function<bool(const std::string&)> has;
  std::function<std::vector<double>(const std::string&)> read;
  std::function<std::string(const std::string&)> place;  ///< returns the place of an array in messages
};

/// Reads the space that a packing fills from field arrays in a file of floc: cell (three lattice vectors), dimension,
/// walls (axis, side and position of each wall), wall_masses (one number per wall, 0 for a wall that forces do not
/// move), periodic (one flag per axis) and gravity.
/// @throws InputError naming the array
ListedSpace space_of_fields(const FieldArrays& arrays);

}  // namespace floc
