#pragma once

#include "floc/base/lanes.h"
#include "floc/geometry/frame.h"

namespace floc {

/// Coulomb friction: an incremental tangential spring K_T capped at mu FNe. The cap reads the ELASTIC part of the
/// normal force, so a contact that carries no net normal force still carries up to mu F0. G08 Eq. 4 (with the mu
/// its printed sliding value lacks).
struct CoulombFriction {
  double coefficient;           ///< mu
  double tangential_stiffness;  ///< K_T (force/length)

  /// Longest spring (length) the cap allows at elastic normal force FNe.
  template <class T>
  T spring_limit(const T& elastic) const {
    return (coefficient / tangential_stiffness) * elastic;
  }
};

}  // namespace floc
