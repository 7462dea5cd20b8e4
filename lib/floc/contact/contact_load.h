#pragma once

namespace floc {

/// Largest load of the contacts of a packing. It bounds stiffnesses that grow with the overlap.
struct ContactLoad {
  double overlap = 0.0;       ///< deepest overlap (length)
  double force = 0.0;         ///< largest elastic force (force)
  double impact_speed = 0.0;  ///< largest relative speed of two grains that meet (length/time)
};

}  // namespace floc
