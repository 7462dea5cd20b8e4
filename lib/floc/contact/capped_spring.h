#pragma once

#include <Eigen/Core>
#include <cmath>

#include "floc/base/lanes.h"

namespace floc {

/// Returns the elongation of a contact spring, shortened to a length of at most `limit` >= 0 without a change of
/// direction. An elongation with one component is clamped; the components of a vector are scaled together, as in a
/// circular Coulomb cone. The history of the contact stores the elongation and not the force. If the limit drops, the
/// spring is shortened; if the limit rises again, the spring does not recover its length.
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

/// Adds `increment` to the elongation of a contact spring, and then shortens the spring so that its force is at most
/// `coefficient` times the elastic part FNe of the normal force. Friction, rolling resistance and twisting resistance
/// follow this rule.
/// @param elastic  elastic part FNe of the normal force (force)
/// @param history  elongation of the spring, updated
/// @return force of the contact spring after the update
template <class V, class T>
inline V respond_capped(double coefficient, double stiffness, const T& elastic, const V& increment,
                        T* history) {
  Eigen::Map<V> spring(history);
  spring = capped(V(spring + increment), T((coefficient / stiffness) * elastic));
  return T(stiffness) * spring;
}

/// Returns whether the force of a contact spring has reached its cap, within a relative tolerance. The cap is
/// `coefficient` times the elastic normal force. A spring at its cap slides as soon as the displacement of the contact
/// grows.
template <class V>
inline bool capped_is_mobilised(double coefficient, double stiffness, double elastic, const double* history,
                                double tolerance) {
  return Eigen::Map<const V>(history).norm() >= (1.0 - tolerance) * ((coefficient / stiffness) * elastic);
}

}  // namespace floc
