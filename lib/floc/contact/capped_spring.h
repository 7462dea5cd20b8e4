#pragma once

#include <cmath>

#include "floc/base/lanes.h"

namespace floc {

/// Shortens a spring to `limit` >= 0, keeping its direction. The spring, not its force, is the history: when the cap
/// drops, the spring is cut with it and does not come back. One component is a plain clamp; several keep their
/// direction (the circular Coulomb cone).
template <class V, class T>
inline V capped(const V& spring, const T& limit) {
  if constexpr (V::RowsAtCompileTime == 1) {
    return V(lanes::clamp_magnitude(T(spring[0]), limit));
  } else {
    using std::sqrt;
    const T squared = spring.squaredNorm();
    const auto beyond = squared > limit * limit;
    const T length = sqrt(lanes::select(beyond, squared, T(1)));
    return spring * lanes::select(beyond, T(limit / length), T(1));
  }
}

}  // namespace floc
