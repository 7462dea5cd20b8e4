#pragma once

#include "floc/base/lanes.h"

namespace floc {

/// Constant attraction -F0 in contact, falling linearly to zero over the range D0 of the gap. Reversible: it acts on
/// approach as on parting. G08 Eq. 2.
struct TailAdhesion {
  double pull_off_force;  ///< F0 (force), > 0
  double tail_range;      ///< D0 (length), > 0

  template <class T>
  T force(const T& gap) const {
    const T tail = lanes::min(T(0), T((pull_off_force / tail_range) * gap - pull_off_force));
    return lanes::select(gap < T(0), T(-pull_off_force), tail);
  }
  /// -dF/dh: negative across the gap, where parting weakens the attraction.
  template <class T>
  T stiffness(const T& gap) const {
    const T tail = lanes::select(gap < T(tail_range), T(-pull_off_force / tail_range), T(0));
    return lanes::select(gap < T(0), T(0), tail);
  }
  /// Zero at and beyond the range; -F0 D0/2 at contact.
  template <class T>
  T energy(const T& gap) const {
    const T missing = lanes::max(T(0), T(tail_range - gap));
    const T tail = T(-0.5 * pull_off_force / tail_range) * missing * missing;
    return lanes::select(gap < T(0), T(pull_off_force * gap - 0.5 * pull_off_force * tail_range), tail);
  }
  double range() const { return tail_range; }
};

}  // namespace floc
