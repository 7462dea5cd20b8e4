#pragma once

#include "floc/io/listed_ids.h"
#include "floc/io/listed_packing.h"
#include "floc/packing/state.h"

namespace floc {

/// Makes the contacts of a packing, with their strengths, from the contacts that a file lists: see assemble(). Grains
/// may lie outside the cell.
/// @return the numbers of contacts that were left out, of contacts whose image is not the listed one, and of bonds
/// @throws InputError under the conditions of assemble() that concern contacts
template <int Dim>
ListedContactCounts add_contacts(const ListedPacking& listed, const Identifiers& identifiers,
                                 State<Dim>& state);

}  // namespace floc
