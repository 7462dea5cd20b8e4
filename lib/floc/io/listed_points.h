#pragma once

#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// Sets the point, the normal and the gap of a contact of grains with corners to the listed values. If the normal or
/// the gap is not listed, it is computed from the shapes at the point.
/// @param reversed  whether the first grain of the contact is the second body in the row
/// @throws InputError if the row contains no point, or if the point is too far from one of the two bodies
template <int Dim>
void place_point(const ListedContact& row, bool reversed, const Packing<Dim>& packing, Contact<Dim>& contact);

/// Sets the keys and types of the contacts of grains with corners. The type of a contact depends on the number of
/// contact points that its two grains have.
/// @param contacts  contacts sorted by pair; on return, the contacts of each pair are sorted by key
template <int Dim>
void number_points(const Packing<Dim>& packing, std::vector<Contact<Dim>>& contacts);

}  // namespace floc
