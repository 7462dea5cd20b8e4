#pragma once

#include <vector>

#include "floc/elasticity/force_increments.h"

namespace floc {

/// Returns which contacts of a network carry part of a small step of stress: those whose force or moment changes by
/// more than rounding. Rounding is 1e-9 of the largest change in any contact; the change of a contact is the square
/// root of the sum of the squares of its forces and of its moments over the grain's size. Contacts of dead ends carry
/// nothing.
/// @return one entry per contact
template <int Dim>
std::vector<bool> mechanical_backbone(const ContactNetwork<Dim>& network, const StepResponse<Dim>& step);

}  // namespace floc
