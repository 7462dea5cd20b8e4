#pragma once

#include <random>

#include "floc/contact/history.h"
#include "floc/packing/packing.h"

namespace floc::test {

/// Returns the part of the history of a contact with Coulomb friction that contains the elongation (length) of the
/// tangential spring. It can be read and written.
template <int Dim>
auto shear_spring(Contact<Dim>& c) {
  return c.history.template segment<kShearComponents<Dim>>(HistoryLayout<Dim>::kFriction);
}
template <int Dim>
Shear<Dim> shear_spring(const Contact<Dim>& c) {
  return c.history.template segment<kShearComponents<Dim>>(HistoryLayout<Dim>::kFriction);
}

/// Returns the part of the history of a contact with rolling resistance that contains the relative rotation (radians).
/// It can be read and written.
template <int Dim>
auto rolling_spring(Contact<Dim>& c) {
  return c.history.template segment<kRotations<Dim>>(HistoryLayout<Dim>::kRolling);
}
template <int Dim>
RotationVector<Dim> rolling_spring(const Contact<Dim>& c) {
  return c.history.template segment<kRotations<Dim>>(HistoryLayout<Dim>::kRolling);
}

/// Returns a reference to the rotation about the normal (radians) in the history of a contact with twisting resistance.
inline double& twisting_spring(Contact<3>& c) {
  return c.history[HistoryLayout<3>::kTwisting];
}

/// Gives every contact of a packing a small random elongation of its spring in the tangent plane, and a small random
/// twist if the law has twisting springs.
template <int Dim>
void stretch_at_random(Packing<Dim>& packing) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> uniform(-1e-3, 1e-3);
  for (Contact<Dim>& c : packing.contacts) {
    auto shear = shear_spring(c);
    for (double& s : shear) s = uniform(engine);
    if constexpr (Dim == 3) shear -= c.normal * c.normal.dot(shear);
    for (double& s : rolling_spring(c)) s = uniform(engine);
    if constexpr (Dim == 3)
      if (packing.law.has_twisting()) twisting_spring(c) = uniform(engine);
  }
}

}  // namespace floc::test
