#pragma once

#include "floc/io/listed_ids.h"
#include "floc/io/listed_packing.h"
#include "floc/packing/packing.h"

namespace floc {

/// Makes the contacts of a packing from the contacts that a file lists, see assemble(). Grains may lie outside the
/// cell.
/// @return the numbers of contacts that were left out, whose image was replaced, or that are bonds
/// @throws InputError under the conditions of assemble() that concern contacts
template <int Dim>
ListedContactCounts add_contacts(const ListedPacking& listed, const Identifiers& identifiers,
                                 Packing<Dim>& packing);

}  // namespace floc
