#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

/// The few operations a contact law needs beyond arithmetic, for every number type it is evaluated on:
/// `double`, a dual number (Ceres' Jet), or a pack of doubles, the comparisons of which give masks with a
/// `blend` of their own.
namespace floc::lanes {

/// `when ? a : b`, lane by lane where the number type has lanes.
template <class Mask, class T>
inline T select(const Mask& when, const T& a, const T& b) {
  if constexpr (std::is_same_v<Mask, bool>) {
    return when ? a : b;
  } else {
    return blend(when, a, b);
  }
}

template <class T>
inline T min(const T& a, const T& b) {
  return select(a < b, a, b);
}

template <class T>
inline T max(const T& a, const T& b) {
  return select(a < b, b, a);
}

/// `value` limited to [-bound, bound], bound >= 0.
template <class T>
inline T clamp_magnitude(const T& value, const T& bound) {
  return max(min(value, bound), T(-bound));
}

}  // namespace floc::lanes
