#pragma once

#include <string>

#include "floc/contact/law.h"
#include "floc/io/hdf5_file.h"

namespace floc {

/// Writes a contact law as attributes of the group `group` of an HDF5 file. The law consists of slots (normal,
/// friction, ...), each of which contains one of several models or none. The attributes of a slot are the keyword of
/// the model in the slot ("none" if the slot is empty) and the parameters of all models of the slot; the parameters of
/// models that are not in the law are zero. Slots and models that the first version of the file format did not contain
/// are written only if the law contains them.
void write_law(Hdf5Writer& file, const Law& law, const std::string& group = "law");

/// Reads a contact law from the attributes that write_law() wrote. @param dimension  dimension of the packing, 2 or 3
/// @throws InputError naming file and attribute for an unknown keyword, an invalid parameter, or a law that does not
/// apply in this dimension
Law read_law(const Hdf5Reader& file, int dimension, const std::string& group = "law");

}  // namespace floc
