#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Reads contacts from the file `options.contacts`, which is not the file of the grains; the grains may be in any
/// format. The format of the file of contacts is recognised from its content: a `dump local` of LAMMPS, a list of
/// interactions of YADE, an .fstat file of MercuryDPM or, otherwise, a csv table with the columns of read_contacts().
/// `options.contact_columns` renames the columns of a LAMMPS dump or of a csv table.
/// @param dimension  dimension of the packing, 2 or 3
/// @param timestep  time step of the grains, if their file gives one. In a LAMMPS dump, the last frame with this time
/// step is read or, without a time step, the last frame.
/// @param remarks  if not null, receives a sentence that describes the layout of a csv table, unless the table is plain
/// @return the contacts; nothing if `options.contacts` is empty
/// @throws InputError naming file, line and column
std::optional<std::vector<ListedContact>> read_contact_file(const ImportOptions& options, int dimension,
                                                            std::optional<std::int64_t> timestep = {},
                                                            std::vector<std::string>* remarks = nullptr);

/// Reads bonds from the file `options.bonds`, which is in any format of a file of contacts. A bond must have a
/// stiffness kn, and it acts across a gap. A bond without a listed force is unstressed.
/// @return the bonds; none if `options.bonds` is empty
/// @throws InputError naming file, line and column
std::vector<ListedContact> read_bond_file(const ImportOptions& options, int dimension);

}  // namespace floc
