#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Whether the step from one equilibrium to another is elastic: no contact opens, closes or becomes mobilised
/// on the straight path between them, nor if the path is continued by its own length. The vibrations after a
/// load is imposed at once, which overshoot by up to that length, then leave the same state.
template <int Dim>
bool is_elastic_step(const Packing<Dim>& from, const Packing<Dim>& to);

}  // namespace floc
