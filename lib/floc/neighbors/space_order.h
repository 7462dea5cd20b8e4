#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Order of the grains along a space-filling curve (Morton order of the reduced coordinates), so that grains
/// close in space are close in memory. Entry k is the index of the k-th grain along the curve. It depends on
/// positions and cell alone; ties keep the order of the indices.
template <int Dim>
std::vector<int> space_order(const Cell<Dim>& cell, const Grains<Dim>& grains);

}  // namespace floc
