#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Reads contacts from the file `options.contacts`. The grains are in another file, which may have any format. The
/// format of the file of contacts is recognised from its content: a `dump local` of LAMMPS, a list of interactions of
/// YADE, an .fstat file of MercuryDPM or, if none of these is recognised, a csv table with the columns of
/// read_contacts(). `options.contact_columns` renames the columns of a LAMMPS dump or of a csv table.
/// @param dimension  dimension of the packing, 2 or 3
/// @param listed  packing with the grains. From a LAMMPS dump, the last frame with their time step is read; if their
/// file gives no time step, the last frame of the dump is read. From an .fstat file, the contacts at their time are
/// read. The remarks of the packing receive sentences about the layout of the csv table, unless this layout is plain,
/// and about columns that are not read.
/// @return the contacts; nothing if `options.contacts` is empty
/// @throws InputError naming file, line and column
std::optional<std::vector<ListedContact>> read_contact_file(const ImportOptions& options, int dimension,
                                                            ListedPacking& listed);

/// Reads bonds from the file `options.bonds`, which may have any format that read_contact_file() accepts. Each bond
/// must have a stiffness kn. A bond acts across a gap. If the file lists no force for a bond, its force is zero.
/// @return the bonds; none if `options.bonds` is empty
/// @throws InputError naming file, line and column
std::vector<ListedContact> read_bond_file(const ImportOptions& options, int dimension, ListedPacking& listed);

}  // namespace floc
