#pragma once

#include <string>

#include "floc/contact/law.h"
#include "floc/io/hdf5_file.h"

namespace floc {

/// Writes a contact law as attributes of a group of an HDF5 file. For each slot of the law (normal, friction, ...) the
/// attributes are the keyword of its model ("none" if the slot is empty) and the parameters (zero if the law does not
/// have them). Slots and models that were added to the file format later are written only if the law has them.
void write_law(Hdf5Writer& file, const Law& law, const std::string& group = "law");

/// Reads a contact law from the attributes that write_law() wrote.
/// @throws InputError naming file and attribute for an unknown keyword, an invalid parameter, or a law that does not
/// apply to packings of this dimension
Law read_law(const Hdf5Reader& file, int dimension, const std::string& group = "law");

}  // namespace floc
