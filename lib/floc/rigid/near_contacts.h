#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Adds the pairs of surfaces that are not in contact but have a gap of at most `gap` to the contacts of a packing,
/// without forces. Such a pair of rigid grains may carry a force, because positions of finite accuracy leave gaps in
/// contacts.
/// @param gap  largest distance of the surfaces (length), >= 0
/// @return number of contacts added
/// @throws InputError if find_pairs() throws it
template <int Dim>
int add_near_contacts(Packing<Dim>& packing, double gap);

}  // namespace floc
