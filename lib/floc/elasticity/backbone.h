#pragma once

#include <vector>

#include "floc/elasticity/force_increments.h"

namespace floc {

/// For each contact of a network, returns whether it carries part of a small change of stress. The change in a contact
/// is the square root of the sum of the squared changes of its force components and moments; the moments are divided by
/// the grain's size. A contact carries part of the change of stress if its change is more than 1e-9 of the largest
/// change in any contact; smaller changes are rounding errors. Contacts of dead ends (grains that hang on a single
/// contact) carry no part.
/// @param step  response of the network to the change of stress
template <int Dim>
std::vector<bool> mechanical_backbone(const ContactNetwork<Dim>& network, const StepResponse<Dim>& step);

}  // namespace floc
