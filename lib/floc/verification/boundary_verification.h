#pragma once

#include "floc/packing/state.h"
#include "floc/verification/verification.h"

namespace floc {

/// Checks the kinetic energy of the boundary of a packing. This energy is not part of the kinetic energy of the grains.
/// With walls, it is the kinetic energy of the walls that can move under the forces of the grains. In a periodic cell,
/// it is the kinetic energy that the grains would have if they followed the deformation of the cell about its centre.
/// The energy of the boundary, divided by the number of grains, must be below the tolerance of the kinetic energy per
/// grain. Fixed walls must have no velocity.
template <int Dim>
Criterion verify_boundary_motion(const State<Dim>& state);

}  // namespace floc
