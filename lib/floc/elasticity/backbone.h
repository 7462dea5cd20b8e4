#pragma once

#include <vector>

#include "floc/elasticity/force_increments.h"

namespace floc {

/// Returns which contacts of a network carry part of a small change of stress. A contact does so if the size of its
/// change is more than 1e-9 of the largest size in any contact; smaller changes are rounding errors. The size is the
/// square root of the sum of the squares of the force changes, and of the moment changes over the grain's size.
/// Contacts of dead ends (grains that hang on a single contact) carry nothing.
/// @param step  response of the network to the change of stress
/// @return for each contact, whether it carries part of the change
template <int Dim>
std::vector<bool> mechanical_backbone(const ContactNetwork<Dim>& network, const StepResponse<Dim>& step);

}  // namespace floc
