#pragma once

#include "floc/io/import.h"

namespace floc {

/// Whether a file begins, after comments, with the header of a packing of jamBashbulk ("N = ... ,L1= { ...").
bool is_jambashbulk(const std::string& path);

/// Reads packing number `options.index` (from 0; default: 0) from a file of the program jamBashbulk (Van Hecke group,
/// Leiden). A packing consists of frictionless 2D disks with linear repulsion in a skewed periodic cell. In the units
/// of jamBashbulk, the energy is the sum, over all contacts, of overlap^2 / 2. The normal stiffness K_N is therefore 1.
/// With this value, the computed pressure of a packing agrees with the pressure in the file within rounding. The target
/// stress is the number P0 in the file. The mass of a grain is the square of its diameter. The format determines the
/// law, the cell and the units, so options that set them are an error.
/// @throws InputError naming file and line for any violation of the format
Imported read_jambashbulk(const std::string& path, const ImportOptions& options);

}  // namespace floc
