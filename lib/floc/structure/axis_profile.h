#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/packing/packing.h"

namespace floc {

/// A slice of the cell between two planes, with the grains whose centres lie in the slice. The planes are parallel to
/// all lattice vectors except the vector along which the cell is divided.
struct ProfileSlice {
  /// Distances (length) of the two planes of the slice from the origin. Between walls, the distances from the lower
  /// wall.
  double low = 0.0, high = 0.0;
  /// Solid fraction, from the exact volume of each grain in the slice. The volume of an overlap counts twice, once for
  /// each of the two grains.
  double solid_fraction = 0.0;
  int n_grains = 0;
  /// Normal stress along each axis (force/length^(Dim-1)), compression positive. The stress is the sum over contacts of
  /// the force times the part of the branch vector that lies in the slice, divided by the volume of the slice.
  std::vector<double> stress;
  /// Means over the grains of the slice, one for each array of values passed to axis_profile(); NaN without grains.
  std::vector<double> mean;
};

inline constexpr WholeRange kProfileSlices{.least = 1, .most = 100000};

/// Divides the cell into slices of equal thickness, and computes the solid fraction, the stress and the mean values of
/// each slice. The mean of the stresses of all slices is static_stress().
/// @param axis    index (from 0) of the lattice vector along which the cell is divided
/// @param n       number of slices
/// @param values  arrays with one number per grain; the mean of each array is computed in every slice
/// @throws InputError if n is not in kProfileSlices
template <int Dim>
std::vector<ProfileSlice> axis_profile(const Packing<Dim>& packing, int axis, int n,
                                       const std::vector<std::vector<double>>& values);

}  // namespace floc
