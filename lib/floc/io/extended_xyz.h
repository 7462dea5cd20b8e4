#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether a file is probably extended XYZ: its first line is a number, and its second line contains "Properties=".
bool is_extended_xyz(const std::string& path);

/// Reads one frame of an extended XYZ file. The comment line of the frame contains the cell as Lattice="ax ay az bx by
/// bz cx cy cz" (unless `options.cell` replaces it) and the key Properties. The properties are pos:R:3, radius (or
/// diameter) and, optionally, mass and id, with the names of read_grains(). The frame number `options.index` (from 0)
/// is read, by default the last frame. If the key pbc is present, it has to be T along every lattice vector of the
/// packing, unless `options.cell` is given. The key dimension gives the dimension; without it, settle_space() decides.
/// In 2D, the cell consists of x and y of the first two lattice vectors. `options.law` is required. `options.contacts`
/// may name a file of contacts: see read_contact_file().
/// @throws InputError naming file and line
Imported read_extended_xyz(const std::string& path, const ImportOptions& options);

/// Returns a state as one frame of extended XYZ, with species, pos, radius, mass and id of every grain and the key
/// dimension. Numbers are printed with all digits needed to read them back exactly. In 2D z = 0 and pbc="T T F".
std::string extended_xyz_text(const AnyState& state);

}  // namespace floc
