#pragma once

namespace floc {

/// Largest overlap, force and impact speed of the contacts of a packing. These values determine upper bounds on contact
/// stiffnesses that grow with the overlap.
struct ContactLoad {
  double overlap = 0.0;       ///< largest overlap (length)
  double force = 0.0;         ///< largest elastic normal force (force)
  double impact_speed = 0.0;  ///< largest relative speed of two grains that collide (length/time)
};

}  // namespace floc
