#pragma once

namespace floc {

/// Largest overlap, force and impact speed of the contacts of a packing. They bound the stiffnesses that grow
/// with the overlap.
struct ContactLoad {
  double overlap = 0.0;       ///< largest overlap (length)
  double force = 0.0;         ///< largest elastic force (force)
  double impact_speed = 0.0;  ///< largest relative speed of two grains that collide (length/time)
};

}  // namespace floc
