#pragma once

#include <string>

#include "floc/packing/state.h"

namespace floc {

/// By how much a state misses the equilibrium it was asked to meet: each residual of its stored forces that is
/// not below its tolerance, with that tolerance and the worst grain. Empty if all are below: the state is an
/// equilibrium.
template <int Dim>
std::string equilibrium_faults(const State<Dim>& state);

/// The largest residual in units of its tolerance.
template <int Dim>
double equilibrium_excess(const State<Dim>& state);

}  // namespace floc
