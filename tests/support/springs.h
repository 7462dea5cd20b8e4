#pragma once

#include "floc/contact/history.h"
#include "floc/packing/contact.h"

namespace floc::test {

/// The tangential spring that a contact remembers under Coulomb friction (length), to read and to set.
template <int Dim>
auto shear_spring(Contact<Dim>& c) {
  return c.memory.template segment<kShearComponents<Dim>>(MemoryLayout<Dim>::kFriction);
}
template <int Dim>
Shear<Dim> shear_spring(const Contact<Dim>& c) {
  return c.memory.template segment<kShearComponents<Dim>>(MemoryLayout<Dim>::kFriction);
}

/// The relative rotation that it remembers under rolling resistance (radians).
template <int Dim>
auto rolling_spring(Contact<Dim>& c) {
  return c.memory.template segment<kRotations<Dim>>(MemoryLayout<Dim>::kRolling);
}
template <int Dim>
RotationVector<Dim> rolling_spring(const Contact<Dim>& c) {
  return c.memory.template segment<kRotations<Dim>>(MemoryLayout<Dim>::kRolling);
}

/// The rotation about the normal that it remembers under resistance to twisting (radians).
inline double& twisting_spring(Contact<3>& c) {
  return c.memory[MemoryLayout<3>::kTwisting];
}

}  // namespace floc::test
