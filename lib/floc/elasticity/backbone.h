#pragma once

#include <vector>

#include "floc/elasticity/force_increments.h"

namespace floc {

/// Returns which contacts of a network carry part of a small change of stress: those whose forces or moments change by
/// more than rounding errors. The size of the change in a contact is the square root of the sum of the squares of its
/// force changes and of its moment changes divided by the grain's size. It exceeds rounding errors if it is more than
/// 1e-9 of the largest change in any contact. Contacts of dead ends (grains that hang on a single contact) carry
/// nothing.
/// @param step  response of the network to the change of stress
/// @return for each contact, whether it carries part of the change
template <int Dim>
std::vector<bool> mechanical_backbone(const ContactNetwork<Dim>& network, const StepResponse<Dim>& step);

}  // namespace floc
