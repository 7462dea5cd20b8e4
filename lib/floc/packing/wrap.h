#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Moves grains by lattice vectors into the cell. @return displacement of each grain, in numbers of lattice vectors
template <int Dim>
std::vector<Vec<Dim, int>> wrap_grains(const Cell<Dim>& cell, Grains<Dim>& grains);

/// Moves the grains of a packing by lattice vectors into the cell, and renumbers the periodic images of its contacts.
/// Axes between walls are not periodic: grains are not moved along them.
template <int Dim>
void wrap_into_cell(Packing<Dim>& packing);

}  // namespace floc
