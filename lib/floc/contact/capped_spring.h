#pragma once

#include <Eigen/Core>
#include <cmath>

#include "floc/base/lanes.h"

namespace floc {

/// Shortens a spring to `limit` >= 0, keeping its direction. The spring, not its force, is the history: when
/// the cap drops, the spring is cut with it and does not come back. One component is a plain clamp; several
/// keep their direction (the circular Coulomb cone).
template <class V, class T>
inline V capped(const V& spring, const T& limit) {
  if constexpr (V::RowsAtCompileTime == 1) {
    return V(lanes::clamp_magnitude(T(spring[0]), limit));
  } else {
    using std::sqrt;
    const T squared = spring.squaredNorm();
    const auto beyond = limit * limit < squared;
    const T length = sqrt(lanes::select(beyond, squared, T(1)));
    return spring * lanes::select(beyond, T(limit / length), T(1));
  }
}

/// An incremental spring whose force is capped at coefficient * FNe, with FNe the ELASTIC part of the normal
/// force: what friction and rolling resistance share. @param history  the spring, updated. @return its force
template <class V, class T>
inline V respond_capped(double coefficient, double stiffness, const T& elastic, const V& increment,
                        T* history) {
  Eigen::Map<V> spring(history);
  spring = capped(V(spring + increment), T((coefficient / stiffness) * elastic));
  return T(stiffness) * spring;
}

/// Whether such a spring is at its cap, to a relative tolerance: it slides as soon as it is pushed further.
template <class V>
inline bool capped_is_mobilised(double coefficient, double stiffness, double elastic, const double* history,
                                double tolerance) {
  return Eigen::Map<const V>(history).norm() >= (1.0 - tolerance) * ((coefficient / stiffness) * elastic);
}

}  // namespace floc
