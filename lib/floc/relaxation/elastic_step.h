#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Whether the step from one equilibrium to another is elastic: no contact opens or closes, and no spring of a contact
/// reaches its cap, on the straight path from the first state to the second and on its extension beyond the second
/// state by the length of this path. Under a suddenly applied load, vibrations overshoot the second state by up to this
/// length; if the step is elastic, the packing then comes to rest in the second state.
template <int Dim>
bool is_elastic_step(const Packing<Dim>& from, const Packing<Dim>& to);

}  // namespace floc
