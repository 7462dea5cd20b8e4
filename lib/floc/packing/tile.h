#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Returns a packing that consists of copies of a given packing side by side, in one cell that contains all copies.
/// With n grains per copy, grain i of copy t has the index t n + i; copies are numbered along the first axis first. All
/// data of grains and contacts are copied; the copies of an equilibrium therefore form an equilibrium with the same
/// stress. Identifiers of grains are dropped, because all copies of a grain would have the same identifier. The result
/// is periodic with the period of the original packing. It can serve as the initial state of a larger packing, but its
/// statistics are those of the original packing.
/// @param copies  number of copies along each lattice vector, >= 1
template <int Dim>
Packing<Dim> tiled(const Packing<Dim>& packing, const Vec<Dim, int>& copies);

}  // namespace floc
