#include "floc/assembly/cluster_flight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/relaxation/relaxation_options.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"
#include "support/springs.h"

namespace floc {
namespace {

constexpr double kOverlap = 1e-5;  ///< overlap F0/K_N of two grains that stick together at rest

/// Returns equal disks of unit diameter at the given positions in a square cell of side 10, and finds their contacts.
Packing<2> disks_at(const std::vector<Vec<2>>& places) {
  Packing<2> packing;
  packing.law = test::cohesive_law();
  packing.cell.matrix *= 10.0;
  packing.grains = Grains<2>::with_size(static_cast<int>(places.size()));
  packing.grains.position = places;
  packing.grains.radius.assign(places.size(), 0.5);
  packing.grains.mass.assign(places.size(), 1.0);
  find_contacts(packing);
  return packing;
}

/// Returns three disks: two that stick together across the cell boundary, and a third one far away. The two
/// disks move, and rotate about their common centre.
Packing<2> drifting_pair() {
  Packing<2> packing = disks_at({Vec<2>(9.8, 2.0), Vec<2>(0.8 - kOverlap, 2.0), Vec<2>(5.0, 7.0)});
  const double spin = 0.01, arm = 0.5 * (1.0 - kOverlap);
  packing.grains.velocity = {Vec<2>(0.02, 0.03 - spin * arm), Vec<2>(0.02, 0.03 + spin * arm),
                             Vec<2>(0.01, 0.0)};
  packing.grains.angular_velocity[0][0] = packing.grains.angular_velocity[1][0] = spin;
  return packing;
}

TEST(ClusterFlight, MovesAClusterAsItsDynamicsDo) {
  const Packing<2> start = drifting_pair();
  ASSERT_EQ(start.contacts.size(), 1u);
  Packing<2> flown = start;
  const ClusterFlight<2> flight(flown);
  EXPECT_LT(flight.inner_energy(), 1e-20);
  EXPECT_EQ(flight.fly(flown, 0.01, 20.0), 20.0);

  const double dt = time_step_of(start, RelaxationOptions{}.time_step);
  const auto fixed = BoundaryControl<2>::fixed();
  const auto dynamics = make_dynamics(start, fixed, {dt, 0.1});
  dynamics->advance(static_cast<int>(20.0 / dt), Motion::free);
  const Packing<2> moved = dynamics->packing();
  for (int i = 0; i < 3; ++i) {
    // ClusterFlight moves the clusters in one step; make_dynamics() moves the grains in many time steps. The final
    // positions differ by less than the motion in one time step. In the computation with many steps, the rotation
    // stretches the contact by 5e-10, which changes the velocities.
    EXPECT_LT((flown.cell.wrapped(flown.grains.position[i]) - moved.grains.position[i]).norm(), 0.05 * dt);
    EXPECT_LT((flown.grains.velocity[i] - moved.grains.velocity[i]).norm(), 1e-6);
    EXPECT_NEAR(flown.grains.orientation[i], moved.grains.orientation[i], 0.02 * dt);
  }
  refresh_contacts(flown);
  ASSERT_EQ(flown.contacts.size(), 1u);
  EXPECT_NEAR(flown.contacts[0].gap, -kOverlap, 1e-13);
}

TEST(ClusterFlight, EndsWhereClustersAreNear) {
  Packing<2> packing = disks_at({Vec<2>(1.0, 1.0), Vec<2>(5.0, 1.0), Vec<2>(1.0, 6.0)});
  packing.grains.velocity = {Vec<2>(0.03, 0.0), Vec<2>(-0.02, 0.0), Vec<2>(0.0, 0.0)};
  EXPECT_NEAR(ClusterFlight<2>(packing).fly(packing, 0.01, 1e6), (3.0 - 0.01) / 0.05, 1e-9);
  EXPECT_NEAR((packing.grains.position[1] - packing.grains.position[0]).norm() - 1.0, 0.01, 1e-9);
}

TEST(ClusterFlight, EndsAfterTheLongestTimeWhereNothingMeets) {
  Packing<2> packing = disks_at({Vec<2>(1.0, 1.0), Vec<2>(5.0, 4.0)});
  EXPECT_EQ(ClusterFlight<2>(packing).fly(packing, 0.01, 1e4), 1e4);
  packing.grains.velocity = {Vec<2>(0.1, 0.0), Vec<2>(-0.1, 0.0)};  // the disks pass each other again and again
  EXPECT_EQ(ClusterFlight<2>(packing).fly(packing, 0.01, 400.0), 400.0);
  EXPECT_NEAR(packing.grains.position[0][0], 41.0, 1e-9);
}

/// A chain whose two ends touch across the cell boundary cannot rotate as a rigid body. The velocities of the first
/// half of its grains point up and those of the second half down, so they contain a deformation of the chain.
TEST(ClusterFlight, DoesNotTurnWhatWindsAroundTheCell) {
  std::vector<Vec<2>> places;
  for (int k = 0; k < 10; ++k) places.emplace_back(k + 0.5, 2.0);
  Packing<2> packing = disks_at(places);
  packing.grains.radius.assign(10, 0.5 + 0.5 * kOverlap);
  find_contacts(packing);
  ASSERT_EQ(packing.contacts.size(), 10u);
  for (int k = 0; k < 10; ++k) packing.grains.velocity[k] = Vec<2>(0.3, k < 5 ? 1e-3 : -1e-3);
  const ClusterFlight<2> flight(packing);
  EXPECT_NEAR(flight.inner_energy(), 0.5e-6, 1e-12);
  flight.fly(packing, 0.01, 2.0);
  for (int k = 0; k < 10; ++k)
    EXPECT_LT((packing.grains.position[k] - (places[k] + Vec<2>(0.6, 0.0))).norm(), 1e-12);
}

TEST(ClusterFlight, MovesSpheresThatWindAroundTheCellWithoutTurningThem) {
  Packing<3> packing;
  packing.law = test::cohesive_law();
  packing.cell.matrix *= 4.0;
  packing.grains = Grains<3>::with_size(4);
  for (int k = 0; k < 4; ++k) packing.grains.position[k] = Vec<3>(k + 0.5, 2.0, 1.0);
  packing.grains.radius.assign(4, 0.5 + 0.5 * kOverlap);
  packing.grains.mass.assign(4, 1.0);
  packing.grains.velocity.assign(4, Vec<3>(0.1, 0.0, 0.2));
  const std::vector<Vec<3>> places = packing.grains.position;
  find_contacts(packing);
  ASSERT_EQ(packing.contacts.size(), 4u);
  EXPECT_EQ(ClusterFlight<3>(packing).fly(packing, 0.01, 2.0), 2.0);
  for (int k = 0; k < 4; ++k)
    EXPECT_LT((packing.grains.position[k] - (places[k] + Vec<3>(0.2, 0.0, 0.4))).norm(), 1e-12);
}

/// The springs of a rotating cluster, and the forces and moments on its spheres, rotate with the cluster and do not
/// change otherwise.
TEST(ClusterFlight, TurnsWhatContactsOfSpheresRemember) {
  Packing<3> packing;
  packing.law = test::cohesive_law();
  packing.law += test::twisting_spring(0.005, 10.0);
  packing.cell.matrix *= 10.0;
  packing.grains = Grains<3>::with_size(3);
  const double side = 1.0 - kOverlap;
  packing.grains.position = {Vec<3>(5.0, 5.0, 5.0), Vec<3>(5.0 + side, 5.0, 5.0),
                             Vec<3>(5.0 + 0.5 * side, 5.0 + 0.5 * std::sqrt(3.0) * side, 5.0)};
  packing.grains.radius.assign(3, 0.5);
  packing.grains.mass.assign(3, 1.0);
  for (int i = 0; i < 3; ++i) {
    const Vec<3> spin(0.02, 0.01, 0.03), arm = packing.grains.position[i] - packing.grains.position[0];
    packing.grains.angular_velocity[i] = spin;
    packing.grains.velocity[i] = spin.cross(arm);
  }
  find_contacts(packing);
  ASSERT_EQ(packing.contacts.size(), 3u);
  for (Contact<3>& c : packing.contacts) {
    const Vec<3> tangent = c.normal.unitOrthogonal();
    test::shear_spring(c) = 1e-7 * tangent;
    test::rolling_spring(c) = 1e-5 * c.normal.cross(tangent);
    test::twisting_spring(c) = 2e-5;
  }
  refresh_contacts(packing);
  const Balance<3> before = net_forces(packing);
  ClusterFlight<3>(packing).fly(packing, 0.01, 40.0);
  refresh_contacts(packing);
  const Balance<3> after = net_forces(packing);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Quaterniond& turn = packing.grains.orientation[i];
    EXPECT_GT(turn.angularDistance(Eigen::Quaterniond::Identity()), 0.5);
    // Overlaps of 1e-5 have rounding errors of 1e-15; the errors of forces are K_N times as large.
    EXPECT_LT((after.force[i] - turn * before.force[i]).norm(), 1e-9);
    EXPECT_LT((after.moment[i] - turn * before.moment[i]).norm(), 1e-9);
    EXPECT_GT(before.moment[i].norm(), 1e-5);
  }
}

}  // namespace
}  // namespace floc
