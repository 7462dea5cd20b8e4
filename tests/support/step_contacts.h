#pragma once

#include <vector>

#include "floc/network/contact_network.h"
#include "floc/rigid/step_contact.h"

/// Bodies and contacts with prescribed values, for tests of the equations of a single time step.
namespace floc::test {

/// Returns n bodies and the ground at rest. The ground is the last body and is fixed.
template <int Dim>
inline BodyMotion<Dim> bodies_and_ground(int n, double mass, const Mat<kRotations<Dim>>& inertia) {
  BodyMotion<Dim> out;
  out.velocity.assign(n + 1, Vec<Dim>::Zero());
  out.angular_velocity.assign(n + 1, RotationVector<Dim>::Zero());
  out.inverse_mass.assign(n + 1, Vec<Dim>::Constant(1.0 / mass));
  out.inverse_mass.back().setZero();
  out.inverse_inertia.assign(n + 1, inertia.inverse());
  out.inverse_inertia.back().setZero();
  return out;
}

template <int Dim>
inline BodyMotion<Dim> balls_and_ground(int n, double mass, double radius) {
  return bodies_and_ground<Dim>(
      n, mass, (Dim == 2 ? 0.5 : 0.4) * mass * radius * radius * Mat<kRotations<Dim>>::Identity());
}

template <int Dim>
inline StepContact<Dim> touching(int i, int j, const Vec<Dim>& arm_i, const Vec<Dim>& arm_j,
                                 const Vec<Dim>& normal, double friction) {
  StepContact<Dim> out{};
  out.i = i;
  out.j = j;
  out.arm_i = arm_i;
  out.arm_j = arm_j;
  out.frame = contact_frame(normal);
  out.friction = friction;
  return out;
}

/// Contacts of a stack of n frictionless disks of diameter 1. Disk 0 is on top; body n is the ground.
inline std::vector<StepContact<2>> stack_of_disks(int n) {
  std::vector<StepContact<2>> contacts;
  for (int k = 0; k < n; ++k)
    contacts.push_back(touching<2>(k, k + 1, {0.0, -0.5}, {0.0, 0.5}, {0.0, -1.0}, 0.0));
  return contacts;
}

}  // namespace floc::test
