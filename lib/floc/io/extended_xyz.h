#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether a file is probably XYZ: the first line is a number, and either the second line contains "Properties="
/// (extended XYZ) or the name of the file ends in .xyz.
bool is_extended_xyz(const std::string& path);

/// Reads one frame of an extended XYZ file: frame number `options.index` (from 0), or the last frame by default. The
/// comment line of a frame contains keys with values. The key Properties names the columns of the frame: pos:R:3,
/// radius (or diameter) and, optionally, mass and id, as in read_grains(); `options.columns` renames them. A plain XYZ
/// file has no key Properties; the names of its columns are their numbers. The following other keys are read:
///   Lattice     cell, as Lattice="ax ay az bx by bz cx cy cz"; in 2D, the x and y components of the first two vectors
///   pbc         T for each lattice vector along which the packing is periodic, F for the others
///   walls       names of the walls at faces of the box, such as "x- x+"; if an axis is not periodic, an end
///               without a wall is open
///   dimension   2 or 3; without this key, settle_space() decides
/// `options.cell` replaces Lattice and pbc. `options.law` is required. `options.contacts` may name a file of contacts:
/// see read_contact_file().
/// @throws InputError naming file and line
Imported read_extended_xyz(const std::string& path, const ImportOptions& options);

/// Returns a state as the text of one frame of extended XYZ, with the key dimension and the columns species, pos,
/// radius, mass and id. Numbers are printed with all digits that are needed to read them back exactly. In 2D z = 0. The
/// key pbc is F along every axis that ends at walls and, in 2D, along z.
std::string extended_xyz_text(const AnyState& state);

}  // namespace floc
