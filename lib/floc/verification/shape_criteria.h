#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/verification/rigid_geometry.h"
#include "floc/verification/verification.h"
#include "floc/verification/violations.h"

/// Criteria for contacts that follow from the shapes of the grains. The criteria apply to rigid grains, and to elastic
/// grains with corners.
namespace floc {

/// Completes a criterion: adds the list of its violations, and decides whether the criterion is met.
Criterion concluded(Criterion criterion, Violations& violations);

/// Compares a stored contact with the contact that is found from positions and shapes: the geometry and the type must
/// agree.
/// @param result  criterion; its value is raised to the error of the geometry if this error is larger
template <int Dim>
void compare_contact(const Packing<Dim>& stored, const Contact<Dim>& c, const Contact<Dim>& found,
                     Criterion& result, Violations& violations);

/// Adds a stored contact to the violations, because its two bodies have no contact point there.
template <int Dim>
void add_lost_contact(const Packing<Dim>& stored, const Contact<Dim>& c, Violations& violations);

/// Returns the criterion geometry: the largest difference (length) between a stored gap, normal or contact point and
/// the value that follows from positions and shapes.
/// @param found  contacts found from positions and shapes, in the order of the contacts of the packing
template <int Dim>
Criterion check_shape_geometry(const Packing<Dim>& stored, const std::vector<Contact<Dim>>& found);

/// Returns the criterion list: number of overlaps in RigidGeometry::overlapping whose pair is missing in the contact
/// list, plus number of contacts that are listed twice or out of order.
template <int Dim>
Criterion check_shape_list(const Packing<Dim>& packing, const RigidGeometry<Dim>& geometry);

}  // namespace floc
