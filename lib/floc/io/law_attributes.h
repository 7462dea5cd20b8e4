#pragma once

#include <string>

#include "floc/contact/law.h"
#include "floc/io/hdf5_file.h"

namespace floc {

/// Writes a contact law as attributes of a group: a keyword for each slot, "none" where it is absent,
/// and every parameter, zero where it is absent.
void write_law(Hdf5Writer& file, const Law& law, const std::string& group = "law");

/// @throws InputError naming file and attribute for an unknown keyword, a parameter that no law can have, or a
/// law that is not for packings of this dimension.
Law read_law(const Hdf5Reader& file, int dimension, const std::string& group = "law");

}  // namespace floc
