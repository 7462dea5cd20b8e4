#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Returns a packing that consists of copies of a packing side by side, in one cell that holds all copies. With
/// n grains per copy, grain i of copy t has the index t n + i; copies are numbered along the first axis first.
/// All data of grains and contacts are copied, so that the tiling of an equilibrium is an equilibrium with the
/// same stress. Identifiers of grains are dropped, because several copies would share them. The result still
/// has the period of the small packing: it can serve as a start for a larger packing, but is not a sample of
/// one.
/// @param copies  number of copies along each lattice vector, >= 1
template <int Dim>
Packing<Dim> tiled(const Packing<Dim>& packing, const Vec<Dim, int>& copies);

}  // namespace floc
