#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Repeats a packing side by side, in one cell that holds all copies. Grain i of copy t of n grains has the
/// index t n + i; copies are numbered along the first axis first. All data of grains and contacts are copied,
/// so that the tiling of an equilibrium is an equilibrium with the same stress. Identifiers are dropped,
/// because several copies would share them. The result has the period of the small packing: it is a start for a
/// larger packing, not a sample of one.
/// @param copies  number of copies along each lattice vector, >= 1
template <int Dim>
Packing<Dim> tiled(const Packing<Dim>& packing, const Vec<Dim, int>& copies);

}  // namespace floc
