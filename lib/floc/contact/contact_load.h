#pragma once

namespace floc {

/// What contacts may have to bear at most, for bounds on stiffnesses that grow with the overlap.
struct ContactLoad {
  double overlap = 0.0;       ///< deepest there is (length)
  double force = 0.0;         ///< largest elastic force (force)
  double impact_speed = 0.0;  ///< at which two grains may meet (length/time)
};

}  // namespace floc
