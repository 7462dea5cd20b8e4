#pragma once

#include <cmath>

namespace floc {

/// Returns the whole number n for which the magnitude of tilt - n * side is at most half of `side`. `tilt` is the
/// component of one lattice vector along another lattice vector of length `side`. Subtracting the second vector n times
/// from the first does not change the lattice. For a tilt of exactly half a side, n is 0.
inline double sides_in_tilt(double tilt, double side) {
  return std::ceil(tilt / side - 0.5);
}

}  // namespace floc
