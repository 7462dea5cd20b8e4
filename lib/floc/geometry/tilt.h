#pragma once

#include <cmath>

namespace floc {

/// Returns the number of whole sides to subtract from the tilt of a lattice vector along another lattice vector of
/// length `side`, so that at most half a side remains. The lattice does not change. For a tilt of exactly half a side
/// the number is 0.
inline double sides_in_tilt(double tilt, double side) {
  return std::ceil(tilt / side - 0.5);
}

}  // namespace floc
