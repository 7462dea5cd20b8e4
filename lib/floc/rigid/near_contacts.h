#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Adds to the contacts of a packing the pairs of surfaces that do not touch but have a gap of at most `gap`. The new
/// contacts have no forces. They are needed because grains that touch may have small gaps if their positions are not
/// exact.
/// @param gap  largest distance of the surfaces (length), >= 0
/// @return number of contacts added
/// @throws InputError if find_pairs() throws it
template <int Dim>
int add_near_contacts(Packing<Dim>& packing, double gap);

}  // namespace floc
