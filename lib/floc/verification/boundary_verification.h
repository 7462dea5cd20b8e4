#pragma once

#include "floc/packing/state.h"
#include "floc/verification/verification.h"

namespace floc {

/// Checks the kinetic energy of the boundary, which the energy of the grains leaves out. It is that of the walls that
/// move under their forces or, in a cell without walls, that of the grains if they followed the motion of the cell
/// about its centre. This energy per grain must be below the tolerance of the kinetic energy of a grain. Fixed walls
/// must have no velocity.
template <int Dim>
Criterion verify_boundary_motion(const State<Dim>& state);

}  // namespace floc
