#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Subtracts a multiple of the first lattice vector from the lattice vector of another axis. Afterwards, the component
/// of the changed vector along the first axis is at most half the length of the first lattice vector. The lattice and
/// the packing do not change. Grains are moved by lattice vectors into the new cell, and the images of the contacts are
/// changed accordingly.
/// @pre the cell is lower triangular and has no walls; axis > 0
template <int Dim>
void reduce_tilt(Packing<Dim>& packing, int axis);

}  // namespace floc
