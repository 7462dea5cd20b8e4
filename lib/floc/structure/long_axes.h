#pragma once

#include <optional>

#include "floc/packing/packing.h"

namespace floc {

/// Order of the long axes e of elongated grains: S is the largest eigenvalue of <(D e e - 1)/(D - 1)>, 1 if all axes are
/// parallel and 0 if their directions are isotropic (a sample of n of them has about 1/sqrt(n)).
template <int Dim>
struct AxesOrder {
  int n_grains = 0;                       ///< number of elongated grains
  double order = 0.0;                     ///< S
  Vec<Dim> direction = Vec<Dim>::Zero();  ///< mean direction of the axes, a unit vector of either sign
};

/// Returns the order of the long axes of the grains whose extent along one axis exceeds the others. The extents are square
/// roots of the second moments of the core of the shape, and count as different if they differ by more than 5 %.
/// @return no value if no grain is elongated
template <int Dim>
std::optional<AxesOrder<Dim>> long_axes_order(const Packing<Dim>& packing);

}  // namespace floc
