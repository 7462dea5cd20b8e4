#pragma once

#include <Eigen/Core>
#include <cmath>

#include "floc/base/lanes.h"

namespace floc {

/// Shortens a spring to a length of at most `limit` >= 0 and keeps its direction. The history of a contact
/// stores the elongation of the spring and not its force: when the limit drops, the spring is shortened and
/// does not recover. A spring with one component is clamped; the components of a vector are scaled together
/// (circular Coulomb cone).
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

/// Updates an incremental spring whose force is capped at `coefficient` times the elastic part FNe of the
/// normal force. Friction and the resistances to rolling and twisting share this rule.
/// @param elastic  FNe (force)
/// @param history  elongation of the spring, updated
/// @return force of the spring
template <class V, class T>
inline V respond_capped(double coefficient, double stiffness, const T& elastic, const V& increment,
                        T* history) {
  Eigen::Map<V> spring(history);
  spring = capped(V(spring + increment), T((coefficient / stiffness) * elastic));
  return T(stiffness) * spring;
}

/// Returns whether the force of a spring has reached its cap (respond_capped()), to a relative tolerance. The
/// spring then slides as soon as the displacement grows.
template <class V>
inline bool capped_is_mobilised(double coefficient, double stiffness, double elastic, const double* history,
                                double tolerance) {
  return Eigen::Map<const V>(history).norm() >= (1.0 - tolerance) * ((coefficient / stiffness) * elastic);
}

}  // namespace floc
