#pragma once

#include "floc/packing/packing.h"
#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"

namespace floc {

/// The packing that grains in motion form now: grains wrapped into the cell, in the order of the packing that was
/// set in motion, and the pairs within the range of their interaction as its contacts.
///
/// @param law, wall_law  that the packing is to have
template <int Dim>
Packing<Dim> packing_from_motion(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                                 const Interactions<Dim>& interactions, const Law& law, const Law& wall_law);

}  // namespace floc
