#pragma once

#include <string>

#include "floc/io/wall_planes.h"

namespace floc {

/// Reads the walls and gravity from an input script of LAMMPS or LIGGGHTS. These commands are read:
///
///   fix ID group wall/gran ... xplane LOW HIGH                                LAMMPS; NULL: no wall
///   fix ID group wall/gran/region ... REGION, region REGION block LOW HIGH ... [open FACE]  LAMMPS; INF: no wall
///   fix ID group wall/gran ... primitive type T xplane POSITION               LIGGGHTS
///   fix ID group wall/gran ... mesh n_meshes N meshes MESH ...                LIGGGHTS, with
///   fix MESH group mesh/surface file FILE.stl type T [scale S] [move X Y Z]
///   fix ID group gravity G vector X Y Z
///
/// A fix that the script removes by the commands unfix or clear is left out. `${name}` is replaced by the number that
/// the command `variable name equal` gives; variables of the style index keep their first value. Lengths in a region
/// are in spacings of the command `lattice`, unless the region has "units box". Other commands are ignored; conditions,
/// loops and jumps are not followed. The accelerations of several fixes gravity are added. Conditions that may add or
/// remove a wall, and fixes of groups other than all, are reported in ListedWalls::doubts.
/// @throws InputError if the script has no wall; naming the line if a wall moves or is not a plane perpendicular to an
/// axis, if a number is expected but the word is not a number, or if a mesh or region is unknown
ListedWalls walls_of_script(const std::string& path);

}  // namespace floc
