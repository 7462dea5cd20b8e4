#pragma once

#include "floc/io/listed_ids.h"
#include "floc/io/listed_packing.h"
#include "floc/packing/state.h"

namespace floc {

/// Makes the contacts of a packing, with their strengths, from the contacts that a file lists: see assemble(). Grains
/// may lie outside the cell.
/// @return the number of contacts that were left out, the number of contacts whose image is not the listed image, and
/// the number of bonds
/// @throws InputError under the conditions of assemble() that concern contacts
template <int Dim>
ListedContactCounts add_contacts(const ListedPacking& listed, const Identifiers& identifiers,
                                 State<Dim>& state);

}  // namespace floc
