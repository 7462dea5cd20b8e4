#pragma once

#include "floc/io/import.h"

namespace floc {

/// Whether a file holds the header of a jamBashbulk packing ("N = ... ,L1= { ...").
bool is_jambashbulk(const std::string& path);

/// Reads packing number `options.index` from a file of jamBashbulk (Van Hecke group, Leiden): 2D disks in a skewed
/// periodic cell, frictionless, with linear repulsion. The energy of jamBashbulk is the sum of overlap^2 / 2 in its
/// own units, so K_N = 1; the pressure that the file gives confirms this to rounding. The target stress is P0 of the
/// file; a grain of unit diameter has unit mass. Law and units follow from the format, so an option that contradicts
/// them is an error.
/// @throws InputError naming file and line for any violation of the format
Imported read_jambashbulk(const std::string& path, const ImportOptions& options);

}  // namespace floc
