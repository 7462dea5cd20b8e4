#pragma once

#include <cmath>

#include "floc/geometry/cell.h"

namespace floc {

/// Strain of a cell at a constant rate. Logarithmic strains of the sides are proportional to time, and so is the change
/// of the offset (component along the first axis) of a sheared lattice vector.
template <int Dim>
struct ImposedStrain {
  /// sides of the cell before and after the strain (length)
  Vec<Dim> from = Vec<Dim>::Zero(), to = Vec<Dim>::Zero();
  std::array<bool, Dim> is_imposed = {};  ///< for each axis: whether its length is imposed
  int sheared_axis = 0;                   ///< axis of the sheared lattice vector; 0 if there is no shear
  /// Offset of the sheared lattice vector before and after the strain (length).
  double offset_from = 0.0, offset_to = 0.0;
  double duration = 0.0;  ///< duration of the strain (time)

  /// Returns the largest of all strains: the logarithmic strains of the imposed lengths, and the shear strain.
  double size() const {
    double largest = sheared_axis > 0 ? std::abs(offset_to - offset_from) / from[sheared_axis] : 0.0;
    for (int a = 0; a < Dim; ++a)
      if (is_imposed[a] && from[a] != to[a]) largest = std::max(largest, std::abs(std::log(to[a] / from[a])));
    return largest;
  }
  /// Whether the strain is complete, up to rounding.
  /// @param time  time since the beginning of the strain (time)
  bool over(double time) const { return duration - time <= 1e-12 * duration; }

  /// Gives the lattice vectors (rows of `matrix`) their lengths and their offset at a time of the strain.
  /// @param time  time since the beginning of the strain (time)
  void set_lattice(double time, Mat<Dim>& matrix) const {
    const bool at_end = over(time);
    const double share = at_end ? 1.0 : time / duration;
    for (int a = 0; a < Dim; ++a)
      if (is_imposed[a]) matrix(a, a) = at_end ? to[a] : from[a] * std::pow(to[a] / from[a], share);
    if (sheared_axis > 0)
      matrix(sheared_axis, 0) = at_end ? offset_to : offset_from + share * (offset_to - offset_from);
  }
};

}  // namespace floc
