#pragma once

namespace floc {

/// The most that contacts may have to bear, for bounds on stiffnesses that grow with the overlap.
struct ContactLoad {
  double overlap = 0.0;       ///< deepest (length)
  double force = 0.0;         ///< largest elastic (force)
  double impact_speed = 0.0;  ///< at which two grains may meet (length/time)
};

}  // namespace floc
