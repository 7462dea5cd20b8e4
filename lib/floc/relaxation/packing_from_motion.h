#pragma once

#include "floc/packing/packing.h"
#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"

namespace floc {

/// Makes a packing from grains in motion. The grains are moved into the cell by lattice vectors and are in the order of
/// the initial packing. The contacts are the pairs whose gap is within the range of their interaction, and the pairs
/// with a liquid bridge.
/// @param law, wall_law  contact laws between grains, and between grains and walls
template <int Dim>
Packing<Dim> packing_from_motion(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                                 const Interactions<Dim>& interactions, const Law& law, const Law& wall_law);

}  // namespace floc
