#pragma once

#include <cmath>

namespace floc {

/// Returns the whole number n for which tilt - n * side is between -side/2 and side/2. `tilt` is the component of one
/// lattice vector along a second lattice vector of length `side`. If the second vector is subtracted n times from the
/// first, the lattice does not change. If `tilt` is exactly half of `side`, n is 0.
inline double sides_in_tilt(double tilt, double side) {
  return std::ceil(tilt / side - 0.5);
}

}  // namespace floc
