#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/verification/rigid_geometry.h"
#include "floc/verification/verification.h"
#include "floc/verification/violations.h"

/// Criteria for contacts that are found from the shapes of the grains. They apply to rigid grains and to elastic grains
/// with corners.
namespace floc {

/// Completes a criterion with the list of its violations.
Criterion concluded(Criterion criterion, Violations& violations);

/// Compares a stored contact with the contact that is found from positions and shapes: the geometry and the type must
/// agree.
/// @param result  criterion; its value becomes the error of the geometry if this error is larger
template <int Dim>
void compare_contact(const Packing<Dim>& stored, const Contact<Dim>& c, const Contact<Dim>& found,
                     Criterion& result, Violations& violations);

/// Adds a stored contact of two bodies that have no contact point there to the violations.
template <int Dim>
void add_lost_contact(const Packing<Dim>& stored, const Contact<Dim>& c, Violations& violations);

/// Returns the criterion geometry: largest difference between the stored gaps, normals and contact points and those that
/// follow from positions and shapes (length).
/// @param found  contacts found from positions and shapes, in the order of those of the packing
template <int Dim>
Criterion check_shape_geometry(const Packing<Dim>& stored, const std::vector<Contact<Dim>>& found);

/// Returns the criterion list: number of overlaps in RigidGeometry::overlapping whose pair is missing in the contact
/// list, plus number of contacts that are listed twice or out of order.
template <int Dim>
Criterion check_shape_list(const Packing<Dim>& packing, const RigidGeometry<Dim>& geometry);

}  // namespace floc
