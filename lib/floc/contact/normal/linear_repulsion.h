#pragma once

#include "floc/base/lanes.h"

namespace floc {

/// Linear elastic repulsion FNe = -K_N h while the surfaces overlap (h < 0), else 0. G08 Eq. 1.
struct LinearRepulsion {
  double normal_stiffness;  ///< K_N (force/length)

  template <class T>
  T force(const T& gap) const {
    return lanes::select(gap < T(0), T(-normal_stiffness * gap), T(0));
  }
  template <class T>
  T stiffness(const T& gap) const {
    return lanes::select(gap < T(0), T(normal_stiffness), T(0));
  }
  template <class T>
  T energy(const T& gap) const {
    return lanes::select(gap < T(0), T(0.5 * normal_stiffness * gap * gap), T(0));
  }
};

}  // namespace floc
