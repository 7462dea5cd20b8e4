#pragma once

#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Returns, as text, the reasons why a saved state is not an equilibrium under its target stress; empty if it is an
/// equilibrium. The residuals are computed from the stored forces. Every residual that is not below its tolerance is
/// listed, together with the tolerance. A net force or net moment is listed with the grain on which it is largest.
template <int Dim>
std::string equilibrium_faults(const State<Dim>& state);

/// Returns the largest ratio of a residual of a saved state to the tolerance of this residual. The result is below 1 in
/// an equilibrium.
template <int Dim>
double equilibrium_excess(const State<Dim>& state);

}  // namespace floc
