#pragma once

#include "floc/io/import.h"

namespace floc {

/// Whether a file holds the header of a jamBashbulk packing ("N = ... ,L1= { ...").
bool is_jambashbulk(const std::string& path);

/// Reads packing number `options.index` of a file of jamBashbulk (Van Hecke group, Leiden): 2D disks in a
/// skewed periodic cell, frictionless, linear repulsion. Its energy is the sum of overlap^2 / 2 in its own
/// units: K_N = 1, which its pressure confirms to rounding. The target stress is its P0; masses are unit mass
/// at unit diameter. Law and units follow from the format, so an option that contradicts them is refused.
/// @throws InputError naming file and line for anything that is not as the format requires.
Imported read_jambashbulk(const std::string& path, const ImportOptions& options);

}  // namespace floc
