#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/packing/packing.h"

namespace floc {

/// A slice of the cell between two planes, with the grains whose centres lie in the slice. The planes are parallel to
/// all lattice vectors except one.
struct ProfileSlice {
  /// Distances of the two planes of the slice from the origin or, between walls, from the lower wall (length).
  double low = 0.0, high = 0.0;
  /// solid fraction from exact volumes; the volume of an overlap counts once for each of its two grains
  double solid_fraction = 0.0;
  int n_grains = 0;
  /// Stress along each axis (force/length^(d-1)), compression positive. Each contact contributes its force times the
  /// part of its branch vector that lies in the slice; the sum is divided by the volume of the slice.
  std::vector<double> stress;
  /// For each array of values passed to axis_profile(): mean of the values over the grains of the slice; NaN if the
  /// slice has no grains.
  std::vector<double> mean;
};

inline constexpr WholeRange kProfileSlices{.least = 1, .most = 100000};

/// Divides the cell into slices of equal thickness, and computes the solid fraction, the stress and the mean values of
/// each slice. The mean of the stresses of all slices is static_stress().
/// @param axis    index, from 0, of the lattice vector that is not parallel to the slices
/// @param n       number of slices
/// @param values  arrays with one number per grain; the mean of each array is computed in every slice
/// @throws InputError if n is not in kProfileSlices
template <int Dim>
std::vector<ProfileSlice> axis_profile(const Packing<Dim>& packing, int axis, int n,
                                       const std::vector<std::vector<double>>& values);

}  // namespace floc
