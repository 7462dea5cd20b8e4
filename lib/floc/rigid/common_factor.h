#pragma once

#include <vector>

#include "floc/rigid/step_contact.h"

namespace floc {

/// Returns the factor s >= 0 by which all impulses p of a step have to be multiplied so that the energy
/// s^2 p' (W + C) p/2 + s p' (u_free + b) is smallest, with the response W, the compliance C, the velocities u_free
/// without impulses and the bias b (step_contact.h). Without friction, the impulses of the step minimise this energy among
/// all p >= 0. The factor is 1 if the impulses change no velocity.
/// @param bodies  motion without the impulses of the contacts
template <int Dim>
double best_common_factor(const BodyMotion<Dim>& bodies, const std::vector<StepContact<Dim>>& contacts);

}  // namespace floc
