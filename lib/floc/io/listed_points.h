#pragma once

#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// Sets the point, the normal and the gap of a contact of grains with corners to those that a file lists. A normal or a gap
/// that is not listed is that of the shapes at the point.
/// @param reversed  whether the first grain of the contact is the second of the row
/// @throws InputError if the row has no point, or if its point is too far from one of the two bodies
template <int Dim>
void place_point(const ListedContact& row, bool reversed, const Packing<Dim>& packing, Contact<Dim>& contact);

/// Gives the contacts of grains with corners their keys and types. The type follows from the number of points of a pair.
/// @param contacts  contacts sorted by pair; those of one pair are sorted by key at the end
template <int Dim>
void number_points(const Packing<Dim>& packing, std::vector<Contact<Dim>>& contacts);

}  // namespace floc
