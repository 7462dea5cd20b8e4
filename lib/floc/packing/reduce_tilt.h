#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Takes whole lengths of the first lattice vector off that of an axis until it reaches along the first axis by
/// at most half a length: the lattice, and with it the packing, stays the same. Grains are brought back into
/// the cell, and the images of contacts follow.
/// @pre the cell is lower triangular, and without walls; axis > 0
template <int Dim>
void reduce_tilt(Packing<Dim>& packing, int axis);

}  // namespace floc
