#pragma once

#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Returns the reasons why a state is not an equilibrium under its target stress: each residual of its stored
/// forces that is not below its tolerance, with this tolerance and the worst grain. Empty if the state is an
/// equilibrium.
template <int Dim>
std::string equilibrium_faults(const State<Dim>& state);

/// Returns the largest ratio of a residual of a state to its tolerance; it is below 1 in an equilibrium.
template <int Dim>
double equilibrium_excess(const State<Dim>& state);

}  // namespace floc
