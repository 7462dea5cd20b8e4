#pragma once

#include <cmath>

namespace floc {

/// Number of whole sides to take off a tilt of a lattice vector along one with this side, so that at most half a side is
/// left: the lattice stays the same. A tilt of just half a side stays.
inline double sides_in_tilt(double tilt, double side) {
  return std::ceil(tilt / side - 0.5);
}

}  // namespace floc
