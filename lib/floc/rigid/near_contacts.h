#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Adds the pairs of surfaces that are not in contact but closer than a gap to the contacts of a packing, without
/// forces. Rigid grains may carry a force there, because positions of finite accuracy leave gaps in contacts.
/// @param gap  largest distance of the surfaces (length), >= 0
/// @return number of contacts added
/// @throws InputError as find_pairs()
template <int Dim>
int add_near_contacts(Packing<Dim>& packing, double gap);

}  // namespace floc
