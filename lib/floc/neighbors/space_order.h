#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Order of the grains in which grains close in space are close in memory. Entry k is the index of the k-th
/// grain. The order depends on positions and cell alone; ties keep the order of the indices. Grains follow a
/// space-filling curve (Morton order of the reduced coordinates). From 10 000 spheres on they are sorted into
/// layers along z, rows along y in each layer, and along x in each row, with rows and layers thinner than a
/// grain. A pass in this order keeps a few layers at a time in the caches and reads memory in long streams.
/// With 108 000 spheres, steps take three quarters of the time that they take along the curve; with 4000
/// spheres the two take equal times.
template <int Dim>
std::vector<int> space_order(const Cell<Dim>& cell, const Grains<Dim>& grains);

}  // namespace floc
