#pragma once

#include <cmath>

#include "floc/geometry/cell.h"

namespace floc {

/// Strain of a cell at a constant rate: the logarithmic strains of sides and the offset of a sheared lattice vector (its
/// component along the first axis) are proportional to time.
template <int Dim>
struct ImposedStrain {
  Vec<Dim> from = Vec<Dim>::Zero(), to = Vec<Dim>::Zero();  ///< sides before and after (length)
  std::array<bool, Dim> is_imposed = {};                    ///< whether the length of an axis is imposed
  int sheared_axis = 0;  ///< axis of the sheared lattice vector; 0 if there is no shear
  double offset_from = 0.0,
         offset_to = 0.0;  ///< offset of the sheared lattice vector before and after (length)
  double duration = 0.0;   ///< (time)

  /// Returns the largest change of a length (logarithmic) or shear strain.
  double size() const {
    double largest = sheared_axis > 0 ? std::abs(offset_to - offset_from) / from[sheared_axis] : 0.0;
    for (int a = 0; a < Dim; ++a)
      if (is_imposed[a] && from[a] != to[a]) largest = std::max(largest, std::abs(std::log(to[a] / from[a])));
    return largest;
  }
  /// Whether the strain is complete at a time since its beginning, up to rounding.
  bool over(double time) const { return duration - time <= 1e-12 * duration; }

  /// Gives the lattice vectors (rows of the matrix) the imposed lengths and offset at a time since the beginning.
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
