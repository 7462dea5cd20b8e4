#pragma once

#include <string>

#include "floc/contact/law.h"
#include "floc/io/hdf5_file.h"

namespace floc {

/// Writes a contact law as attributes of a group: the keyword of each slot ("none" if it is empty) and every
/// parameter (zero if it is absent). Slots and models that are not in every file are written only if the law has
/// them.
void write_law(Hdf5Writer& file, const Law& law, const std::string& group = "law");

/// Reads a contact law from the attributes of a group.
/// @throws InputError naming file and attribute for an unknown keyword, an invalid parameter, or a law that does not
/// apply to packings of this dimension
Law read_law(const Hdf5Reader& file, int dimension, const std::string& group = "law");

}  // namespace floc
