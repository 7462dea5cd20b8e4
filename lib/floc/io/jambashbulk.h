#pragma once

#include "floc/io/import.h"

namespace floc {

/// Whether a file holds the header of a jamBashbulk packing ("N = ... ,L1= { ...").
bool is_jambashbulk(const std::string& path);

/// Reads packing number `options.index` from a file of the program jamBashbulk (Van Hecke group, Leiden). A packing
/// consists of frictionless 2D disks with linear repulsion in a skewed periodic cell. The energy is the sum of
/// overlap^2 / 2 over the contacts, in the units of jamBashbulk, so the normal stiffness K_N is 1; the pressure in the
/// file confirms this value within rounding. The target stress is P0 of the file. A grain of unit diameter has unit
/// mass. The format determines law, cell and units, so options that set them are an error.
/// @throws InputError naming file and line for any violation of the format
Imported read_jambashbulk(const std::string& path, const ImportOptions& options);

}  // namespace floc
