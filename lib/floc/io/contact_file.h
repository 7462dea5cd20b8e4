#pragma once

#include <optional>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Contacts from the file `options.contacts`, in the format that its content shows, for grains of any format: a
/// `dump local` of LAMMPS, interactions of YADE, or else a csv with the columns of read_contacts();
/// `options.contact_columns` renames the columns of the first and the last. Nothing if no file is named.
/// @param timestep  of the grains; the frame of a dump with it is read, or the last frame without one
/// @throws InputError naming file, line and column.
std::optional<std::vector<ListedContact>> read_contact_file(const ImportOptions& options, int dimension,
                                                            std::optional<std::int64_t> timestep = {});

}  // namespace floc
