#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns an order in which to store the grains, such that grains that are close in space are close in memory. Entry k
/// of the result is the index of the k-th grain. The order depends only on the positions and the cell; grains at equal
/// positions keep the order of their indices. Grains in 2D, and fewer than 10 000 spheres, are ordered along a
/// space-filling curve (Morton order of the reduced coordinates). More spheres are sorted into layers along z, within a
/// layer into rows along y, and within a row along x; rows and layers are thinner than a grain. In this order, a loop
/// over the grains needs only a few layers at a time in the caches and reads memory sequentially. With 108 000 spheres,
/// time steps take a quarter less time than in the order along the curve. With 4000 spheres, both orders are equally
/// fast.
template <int Dim>
std::vector<int> space_order(const Cell<Dim>& cell, const Grains<Dim>& grains);

}  // namespace floc
