#pragma once

#include <algorithm>

#include "floc/picture/drawn_scale.h"
#include "floc/picture/packing_picture.h"

namespace floc {

/// Returns the width (points) of the line that shows a contact.
/// @param diameter  mean diameter of the grains (points)
template <int Dim>
double drawn_width(const ContactLine<Dim>& line, const DrawnScale& scale, double diameter) {
  // Smallest widths of lines, divided by the mean diameter, so that contacts with small forces remain visible.
  constexpr double kFaintest = 0.02;
  constexpr double kMarked = 0.09;
  if (line.kind == LineKind::lost || line.kind == LineKind::gained) return 1.5 * kMarked * diameter;
  const double least = (line.kind == LineKind::distant ? kMarked : kFaintest) * diameter;
  return std::max(least, scale.points_per_force * line.force);
}

}  // namespace floc
