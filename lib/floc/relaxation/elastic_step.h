#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Whether the step from one equilibrium to another is elastic: on the way between them, and as far again
/// beyond, no contact opens, closes or is mobilised. The vibrations after a load is put on at once then leave
/// no trace either.
template <int Dim>
bool is_elastic_step(const Packing<Dim>& from, const Packing<Dim>& to);

}  // namespace floc
