#pragma once

#include <optional>
#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// Returns the unit vector along a listed normal. Its length may differ from 1 by the rounding error of four digits.
/// @throws InputError naming `place` if the length differs more
Eigen::Vector3d unit_normal(const FileLine& place, const Eigen::Vector3d& listed);

/// Returns the periodic image of the second body at whose surface the listed contact point lies, if there is exactly
/// one such image among the nearest image and its neighbours.
/// @param contact  contact of two grains, which are the bodies of `row` in the same order, with the nearest image of
/// the second one, or an image beside it
/// @pre row.point has a value
template <int Dim>
std::optional<Vec<Dim, int>> image_at_point(const ListedContact& row, const Packing<Dim>& packing,
                                            const Contact<Dim>& contact);

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
