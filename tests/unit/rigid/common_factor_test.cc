#include "floc/rigid/common_factor.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/step_contacts.h"

namespace floc::test {
namespace {

TEST(BestCommonFactor, GivesTheImpulsesOfAStackTheirSize) {
  constexpr int kDisks = 20;
  constexpr double kMass = 2.0, kGravity = 3.0, kStep = 0.1, kShare = 0.3;
  std::vector<StepContact<2>> contacts = stack_of_disks(kDisks);
  BodyMotion<2> bodies = balls_and_ground<2>(kDisks, kMass, 0.5);
  for (int k = 0; k < kDisks; ++k) {
    bodies.velocity[k] = {0.0, -kStep * kGravity};
    contacts[k].impulse[0] = kShare * kStep * (k + 1) * kMass * kGravity;
  }
  EXPECT_NEAR(best_common_factor(bodies, contacts), 1.0 / kShare, 1e-12);
}

/// Two balls in a cell that moves under a stress, with a tangential impulse, adhesion, bias and compliance. The factor is
/// compared with the minimum of the energy in a closed form.
template <int Dim>
void expect_factor_of_a_pair() {
  constexpr double kMass = 1.5, kRadius = 0.5, kAdhesion = 0.2, kStretchMass = 7.0;
  BodyMotion<Dim> bodies = balls_and_ground<Dim>(2, kMass, kRadius);
  bodies.velocity[0] = 0.3 * Vec<Dim>::Ones();
  bodies.velocity[1] = -0.8 * Vec<Dim>::Unit(0);
  bodies.stretch = -0.1 * Vec<Dim>::Unit(0);
  bodies.inverse_stretch_mass = Vec<Dim>::Constant(1.0 / kStretchMass);
  const Vec<Dim> arm = kRadius * Vec<Dim>::Unit(0);
  StepContact<Dim> c = touching<Dim>(0, 1, arm, -arm, Vec<Dim>::Unit(0), 0.5);
  c.branch = 2.0 * arm;
  c.adhesion = kAdhesion;
  c.bias = 0.05 * Vec<Dim>::Ones();
  c.normal_compliance = 0.4;
  c.tangential_compliance = 0.6;
  c.impulse = 0.7 * Vec<Dim>::Unit(0) - 0.1 * Vec<Dim>::Unit(1);
  // The response of the normal velocity is 2/m + r^2/M. That of the tangential velocity contains the rotation of the two
  // balls, with the moments of inertia of balls_and_ground().
  const double normal = 2.0 / kMass + 4.0 * kRadius * kRadius / kStretchMass;
  const double tangential = 2.0 / kMass + 2.0 * kRadius * kRadius * bodies.inverse_inertia[0](0, 0);
  const Vec<Dim> u = c.frame.transpose() *
                     Vec<Dim>(bodies.velocity[1] - bodies.velocity[0] + bodies.stretch.cwiseProduct(c.branch));
  const double t = c.impulse[1], p = c.impulse[0];
  const double work = p * (u[0] - normal * kAdhesion + c.bias[0]) + t * (u[1] + c.bias[1]);
  const double twice_energy =
      p * p * (normal + c.normal_compliance) + t * t * (tangential + c.tangential_compliance);
  ASSERT_LT(work, 0.0);
  EXPECT_NEAR(best_common_factor<Dim>(bodies, {c}), -work / twice_energy, 1e-12);
}

TEST(BestCommonFactor, IsThatOfTheLeastEnergy) {
  expect_factor_of_a_pair<2>();
  expect_factor_of_a_pair<3>();
}

TEST(BestCommonFactor, IsOneWithoutImpulsesAndZeroIfContactsOpen) {
  BodyMotion<2> bodies = balls_and_ground<2>(2, 1.0, 0.5);
  StepContact<2> c = touching<2>(0, 1, {0.5, 0.0}, {-0.5, 0.0}, {1.0, 0.0}, 0.0);
  bodies.velocity[1] = {3.0, 0.0};
  EXPECT_EQ(best_common_factor<2>(bodies, {c}), 1.0);
  c.impulse[0] = 0.5;
  EXPECT_EQ(best_common_factor<2>(bodies, {c}), 0.0);
}

}  // namespace
}  // namespace floc::test
