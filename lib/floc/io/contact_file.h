#pragma once

#include <optional>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Contacts of the file `options.contacts`, of whatever format its content is, beside grains of any format: a
/// `dump local` of LAMMPS, interactions of YADE, or else a csv with the columns of read_contacts();
/// `options.contact_columns` renames the columns of the first and the last. Nothing if no file is named.
/// @param timestep  of the grains; of a dump the frame with it is read, without one the last
/// @throws InputError naming file, line and column.
std::optional<std::vector<ListedContact>> read_contact_file(const ImportOptions& options, int dimension,
                                                            std::optional<std::int64_t> timestep = {});

}  // namespace floc
