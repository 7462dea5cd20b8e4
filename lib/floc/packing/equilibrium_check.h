#pragma once

#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Returns the reasons why a saved state is not an equilibrium under its target stress, as text; empty if it is an
/// equilibrium. Each residual of the stored forces that is not below its tolerance is one reason. The text contains the
/// residual and the tolerance. For a net force or a net moment, the text also names the grain on which it is largest.
template <int Dim>
std::string equilibrium_faults(const State<Dim>& state);

/// Divides each residual of a saved state by its tolerance, and returns the largest of these ratios. The result is
/// below 1 in an equilibrium.
template <int Dim>
double equilibrium_excess(const State<Dim>& state);

}  // namespace floc
