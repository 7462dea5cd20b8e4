#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Recomputes gap, normal, static forces, stiffnesses and flags of one contact from the positions of its grains and
/// the springs it remembers, by the packing's law. Springs beyond their cap are cut back, those of a parted contact,
/// or of a slot that the law has not, cleared. `contact.i`, `j`, `image` and the springs are read, everything else is written.
template <int Dim>
void refresh_contact(const Packing<Dim>& packing, Contact<Dim>& contact);

/// The same for every contact of the packing; contacts out of the law's range are removed.
template <int Dim>
void refresh_contacts(Packing<Dim>& packing);

}  // namespace floc
