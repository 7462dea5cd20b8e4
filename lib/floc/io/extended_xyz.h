#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether a file's first line is a number and its second has Properties=.
bool is_extended_xyz(const std::string& path);

/// Reads one frame of an extended XYZ file. Its comment line gives Lattice="ax ay az bx by bz cx cy cz", unless
/// `options.cell` replaces it, and Properties with pos:R:3 and radius (or diameter) and, if present, mass and id,
/// named as in read_grains(). Of several frames, `options.index` (from 0) is read, by default the last. If pbc is
/// present, it has to be T along every vector that is used, unless `options.cell` is given. The dimension is that of
/// the key dimension, or else of settle_space(); in 2D, x and y of the first two vectors are taken. `options.law` is
/// required; `options.contacts` may name a csv file, as in read_csv_packing().
/// @throws InputError naming file and line
Imported read_extended_xyz(const std::string& path, const ImportOptions& options);

/// Returns one frame with species, pos, radius, mass and id, each with every digit, and the key dimension. In 2D z =
/// 0 and pbc="T T F".
std::string extended_xyz_text(const AnyState& state);

}  // namespace floc
