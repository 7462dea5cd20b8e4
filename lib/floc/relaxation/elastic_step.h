#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Whether the step from one equilibrium to another is elastic, that is, no contact opens or closes and no spring of a
/// contact reaches its cap. Contacts and springs have to meet this condition on the straight path between the two
/// states and on an equally long extension of the path beyond the second state. The extension is needed because
/// vibrations under a suddenly applied load may overshoot the second state by the length of the path. If the step is
/// elastic, the packing comes to rest in the second state.
template <int Dim>
bool is_elastic_step(const Packing<Dim>& from, const Packing<Dim>& to);

}  // namespace floc
