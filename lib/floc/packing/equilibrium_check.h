#pragma once

#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Returns the reasons why a saved state is not an equilibrium under its target stress, in words; empty if it is an
/// equilibrium. Each residual of the stored forces that is not below its tolerance is a reason. It is given with the
/// tolerance and, if it is a net force or moment, with the grain on which the force or moment is largest.
template <int Dim>
std::string equilibrium_faults(const State<Dim>& state);

/// Returns the largest ratio of a residual of a saved state to the tolerance for this residual; below 1 in an
/// equilibrium.
template <int Dim>
double equilibrium_excess(const State<Dim>& state);

}  // namespace floc
