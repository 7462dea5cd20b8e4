#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Whether the step from one equilibrium to another is elastic: no contact opens or closes and no spring of a contact
/// reaches its cap on the straight path from the first state to the second, nor if the path is continued by its own
/// length. If a load is imposed at once, vibrations overshoot the second state by up to the length of this path; if the
/// step is elastic, the packing then comes to rest in the second state.
template <int Dim>
bool is_elastic_step(const Packing<Dim>& from, const Packing<Dim>& to);

}  // namespace floc
