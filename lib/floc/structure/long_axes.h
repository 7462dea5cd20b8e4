#pragma once

#include <optional>

#include "floc/packing/packing.h"

namespace floc {

/// Orientational order of the long axes of elongated grains. The order S is the largest eigenvalue of the mean of the
/// tensors (D e e - 1)/(D - 1) over the grains, where e is the unit vector along the long axis, and D the dimension. S
/// is 1 if all axes are parallel, and 0 if their directions are isotropic. For n axes with random directions, S is
/// about 1/sqrt(n).
template <int Dim>
struct AxesOrder {
  int n_grains = 0;    ///< number of elongated grains
  double order = 0.0;  ///< order S of the axes, from 0 to 1
  /// Mean direction of the axes: a unit vector with arbitrary sign.
  Vec<Dim> direction = Vec<Dim>::Zero();
};

/// Returns the order of the long axes of the elongated grains. A grain is elongated if its largest extent is more than
/// 5 % larger than its second largest extent. Extents are the square roots of the principal second moments of the core
/// of the shape (the shape without its rounding).
/// @return no value if no grain is elongated
template <int Dim>
std::optional<AxesOrder<Dim>> long_axes_order(const Packing<Dim>& packing);

}  // namespace floc
