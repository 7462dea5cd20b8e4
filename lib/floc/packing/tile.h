#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// A packing repeated side by side, in one cell that holds all copies: grain i of copy t has the index t n + i,
/// copies count along the first axis first. Everything about grains and contacts is copied, so the tiling of an
/// equilibrium is an equilibrium with the same stress; identifiers are not, as several copies would share them. Being periodic on the small scale, it is a start for a
/// larger packing, not a sample of one.
///
/// @param copies  along each lattice vector, >= 1
template <int Dim>
Packing<Dim> tiled(const Packing<Dim>& packing, const Vec<Dim, int>& copies);

}  // namespace floc
