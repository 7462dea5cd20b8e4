#pragma once

#include <vector>

#include "floc/elasticity/force_increments.h"

namespace floc {

/// Returns, for each contact of a network, whether it carries part of a small change of stress. The change in a contact
/// is sqrt(sum of squares), where the sum runs over the changes of its force components and of its moments, the latter
/// divided by the grain's size. A contact carries a part if its change is more than 1e-9 of the largest change in any
/// contact; smaller changes are rounding errors. Contacts of dead ends (grains that hang on a single contact) carry
/// nothing.
/// @param step  response of the network to the change of stress
template <int Dim>
std::vector<bool> mechanical_backbone(const ContactNetwork<Dim>& network, const StepResponse<Dim>& step);

}  // namespace floc
