#pragma once

#include "floc/packing/state.h"
#include "floc/verification/verification.h"

namespace floc {

/// The kinetic energy of the boundary, which the energy of the grains leaves out: of the walls that follow their
/// forces, and of the grains as they would follow the motion of the cell about its centre. A grain's share of it is
/// held to the tolerance of a grain's kinetic energy. Walls that stand still have no velocity at all.
template <int Dim>
Criterion verify_boundary_motion(const State<Dim>& state);

}  // namespace floc
