#pragma once

#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Returns the reasons why a saved state is not an equilibrium under its target stress, as text; empty if it is an
/// equilibrium. Each residual of the stored forces that is not below its tolerance is a reason. The text contains the
/// residual and its tolerance and, for a net force or moment, the grain on which it is largest.
template <int Dim>
std::string equilibrium_faults(const State<Dim>& state);

/// Returns the largest ratio of a residual of a saved state to its tolerance. The ratio is below 1 in an equilibrium.
template <int Dim>
double equilibrium_excess(const State<Dim>& state);

}  // namespace floc
