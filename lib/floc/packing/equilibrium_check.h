#pragma once

#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Reasons why a state is not an equilibrium under its target stress: each residual of its stored forces that
/// is not below its tolerance, with that tolerance and the worst grain. Empty if the state is an equilibrium.
template <int Dim>
std::string equilibrium_faults(const State<Dim>& state);

/// Largest ratio of a residual of a state to its tolerance; below 1 in an equilibrium.
template <int Dim>
double equilibrium_excess(const State<Dim>& state);

}  // namespace floc
