#pragma once

#include "floc/io/listed_ids.h"
#include "floc/io/listed_packing.h"
#include "floc/packing/state.h"

namespace floc {

/// Makes the contacts of a packing, and their strengths, from the contacts that a file lists: see assemble(). Grains need not
/// lie in the cell.
/// @return the numbers of the contacts that were left out, or have another image than the listed one, or are bonds
/// @throws InputError under the conditions of assemble() that concern contacts
template <int Dim>
ListedContactCounts add_contacts(const ListedPacking& listed, const Identifiers& identifiers,
                                 State<Dim>& state);

}  // namespace floc
