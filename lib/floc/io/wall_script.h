#pragma once

#include <string>

#include "floc/io/wall_planes.h"

namespace floc {

/// Reads the walls and the weight that an input script of LAMMPS or LIGGGHTS gives to its grains:
///
///   fix ID group wall/gran ... xplane LOW HIGH                                LAMMPS; NULL: no wall
///   fix ID group wall/gran/region ... REGION, region REGION block LOW HIGH ...  LAMMPS; INF: no wall
///   fix ID group wall/gran ... primitive type T xplane POSITION               LIGGGHTS
///   fix ID group wall/gran ... mesh n_meshes N meshes MESH ...                LIGGGHTS, with
///   fix MESH group mesh/surface file FILE.stl type T [scale S] [move X Y Z]
///   fix ID group gravity G vector X Y Z
///
/// Fixes that the script takes back by unfix are left out. `${name}` stands for a number that `variable name equal` gives.
/// Other commands, and the order in which loops and jumps run them, are not regarded.
/// @throws InputError naming the line for a wall that is no plane across an axis or that moves, a number that is none, an
/// unknown mesh or region; also if the script has no wall
ListedWalls walls_of_script(const std::string& path);

}  // namespace floc
