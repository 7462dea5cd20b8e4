#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Moves the grains of a packing by lattice vectors into the cell, and changes the periodic images of its contacts
/// accordingly. Axes between walls are not periodic: grains are not moved along them.
template <int Dim>
void wrap_into_cell(Packing<Dim>& packing);

}  // namespace floc
