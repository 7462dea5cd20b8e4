#pragma once

#include "floc/base/lanes.h"

namespace floc {

/// Rolling resistance: an incremental spring K_R on the relative rotation, its moment capped at mu_R FNe (elastic
/// part only). G07 section II.
struct RollingSpring {
  double coefficient;        ///< mu_R, a length
  double rolling_stiffness;  ///< K_R (force * length)

  /// Largest relative rotation (radians) the cap allows at elastic normal force FNe.
  template <class T>
  T spring_limit(const T& elastic) const {
    return (coefficient / rolling_stiffness) * elastic;
  }
};

}  // namespace floc
