#pragma once

#include "floc/base/lanes.h"

namespace floc {

/// Constant attraction -F0 in contact and nothing beyond it: the limit of `TailAdhesion` for D0 -> 0.
struct ConstantAdhesion {
  double pull_off_force;  ///< F0 (force), > 0

  template <class T>
  T force(const T& gap) const {
    return lanes::select(gap < T(0), T(-pull_off_force), T(0));
  }
  template <class T>
  T stiffness(const T&) const {
    return T(0);
  }
  template <class T>
  T energy(const T& gap) const {
    return lanes::select(gap < T(0), T(pull_off_force * gap), T(0));
  }
  double range() const { return 0.0; }
};

}  // namespace floc
