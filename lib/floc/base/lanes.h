#pragma once

#include <algorithm>
#include <cmath>

/// The few operations a contact law needs beyond arithmetic, for every number type it is evaluated on. Laws call
/// them unqualified: `double` finds these, a dual number (Ceres' Jet) finds its own sqrt and abs beside the generic
/// select, and a SIMD pack will bring its own overloads.
namespace floc::lanes {

/// `when ? a : b`, without a branch where the number type has lanes.
template <class T>
inline T select(bool when, const T& a, const T& b) {
  return when ? a : b;
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
