#pragma once

#include <optional>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Reads contacts from the file `options.contacts`, for grains of any format. The content of the file decides on its
/// format: a `dump local` of LAMMPS, interactions of YADE, or else a csv with the columns of read_contacts().
/// `options.contact_columns` renames the columns of the first and the last of these.
/// @param timestep  time step of the grains; the frame of a dump with this time step is read, or without it the last
/// frame
/// @return the contacts; nothing if no file is named
/// @throws InputError naming file, line and column
std::optional<std::vector<ListedContact>> read_contact_file(const ImportOptions& options, int dimension,
                                                            std::optional<std::int64_t> timestep = {});

}  // namespace floc
