#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Describes a packing by the lattice vector of an axis that reaches along the first one by at most half of its
/// length, whole lengths taken off: the lattice, and with it the packing, stays the same. Grains are brought back
/// into the cell, and the images of contacts follow.
/// @pre the cell is lower triangular, and without walls; axis > 0
template <int Dim>
void unslant(Packing<Dim>& packing, int axis);

}  // namespace floc
