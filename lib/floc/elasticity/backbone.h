#pragma once

#include <vector>

#include "floc/elasticity/force_increments.h"

namespace floc {

/// Contacts in which a small step changes a force by more than rounding: more than 1e-9 of the largest change
/// of its kind in any contact, with moments divided by the grain's size. The contacts of dead ends are not
/// among them.
/// @return one entry per contact
template <int Dim>
std::vector<bool> mechanical_backbone(const ContactNetwork<Dim>& network, const StepResponse<Dim>& step);

}  // namespace floc
