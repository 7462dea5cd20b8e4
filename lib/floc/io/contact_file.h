#pragma once

#include <optional>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Reads contacts from the file `options.contacts`; the file of the grains may have any format. The format of the
/// contacts is recognised from the content of their file: a `dump local` of LAMMPS, a list of interactions of YADE or,
/// otherwise, a csv table with the columns of read_contacts(). `options.contact_columns` renames the columns of a
/// LAMMPS dump or of a csv table.
/// @param timestep  time step of the grains. Of a LAMMPS dump, the frame with this time step is read, or the last frame
/// if no time step is given.
/// @return the contacts; nothing if `options.contacts` is empty
/// @throws InputError naming file, line and column
std::optional<std::vector<ListedContact>> read_contact_file(const ImportOptions& options, int dimension,
                                                            std::optional<std::int64_t> timestep = {});

}  // namespace floc
