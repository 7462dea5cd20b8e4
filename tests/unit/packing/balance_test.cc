#include "floc/packing/balance.h"

#include <gtest/gtest.h>

namespace floc {
namespace {

/// Disks of radii 1 and 0.5 at (1, 1) and (2.4, 1) in a cell of 10 x 10, with an overlap of 0.1. The contact
/// exerts F_N = 3, and on the first disk a tangential force of 0.5 along +y and a moment of 0.25.
Packing<2> two_disks() {
  Packing<2> packing;
  packing.cell.matrix *= 10.0;
  packing.grains = Grains<2>::with_size(2);
  packing.grains.radius = {1.0, 0.5};
  packing.grains.mass = {4.0, 1.0};
  packing.grains.position = {Vec<2>(1.0, 1.0), Vec<2>(2.4, 1.0)};
  Contact<2> c;
  c.j = 1;
  c.gap = -0.1;
  c.normal = {1.0, 0.0};
  c.arm_i = {14.0 / 15.0, 0.0};
  c.arm_j = {-7.0 / 15.0, 0.0};
  c.normal_force = 3.0;
  c.shear_force = {0.0, 0.5};
  c.rolling_moment[0] = 0.25;
  packing.contacts = {c};
  return packing;
}

TEST(NetForces, OfOneContactAreThoseComputedByHand) {
  const Balance<2> net = net_forces(two_disks());
  EXPECT_NEAR((net.force[0] - Vec<2>(-3.0, 0.5)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((net.force[1] - Vec<2>(3.0, -0.5)).norm(), 0.0, 1e-15);
  // The lever arms are l = R r/(Ri + Rj) with r = 1.4, which gives 14/15 and 7/15. The tangential force on disk j
  // points down and acts on the left side of the disk.
  EXPECT_NEAR(net.moment[0][0], 14.0 / 15.0 * 0.5 + 0.25, 1e-15);
  EXPECT_NEAR(net.moment[1][0], 7.0 / 15.0 * 0.5 - 0.25, 1e-15);
}

TEST(StaticStress, OfOneContactIsForceTimesBranchOverArea) {
  const Mat<2> stress = static_stress(two_disks());
  // The force on disk j is (3, -0.5), the branch (1.4, 0), the area 100. Compression is positive.
  EXPECT_NEAR(stress(0, 0), 3.0 * 1.4 / 100, 1e-16);
  EXPECT_NEAR(stress(1, 0), -0.5 * 1.4 / 100, 1e-16);
  EXPECT_EQ(stress(0, 1), 0.0);
  EXPECT_EQ(stress(1, 1), 0.0);
}

TEST(StaticStress, TakesTheBranchThroughTheBoundary) {
  Packing<2> packing = two_disks();
  packing.cell.matrix << 10.0, 0.0, 3.0, 10.0;
  // The contact is that of two_disks(). The stored position of the second disk is one cell lower: it is shifted by
  // minus the second lattice vector, (3, 10).
  packing.grains.position[1] -= Vec<2>(3.0, 10.0);
  packing.contacts[0].image = {0, 1};
  EXPECT_NEAR(static_stress(packing)(0, 0), 3.0 * 1.4 / 100, 1e-16);
}

TEST(BoundaryStress, IsTheForceAcrossAFaceOverItsArea) {
  EXPECT_EQ(boundary_stress(two_disks()), Mat<2>(Mat<2>::Zero()));  // both disks are inside the cell
  Packing<2> packing = two_disks();
  packing.grains.position[0] += Vec<2>(8.0, 0.0);
  packing.grains.position[1] -= Vec<2>(2.0, 0.0);
  packing.contacts[0].image = {1, 0};
  const Mat<2> stress = boundary_stress(packing);
  EXPECT_NEAR(stress(0, 0), 3.0 / 10.0, 1e-16);
  EXPECT_NEAR(stress(1, 0), -0.5 / 10.0, 1e-16);
  EXPECT_EQ(stress(0, 1), 0.0);
  EXPECT_EQ(stress(1, 1), 0.0);
}

TEST(BoundaryStress, DiffersFromTheStaticStressByTheMomentsOfTheNetForces) {
  Packing<2> packing = two_disks();
  packing.cell.matrix << 10.0, 0.0, 3.0, 10.0;
  packing.grains.position[1] -= Vec<2>(3.0, 10.0);
  packing.contacts[0].image = {0, 1};
  const Balance<2> net = net_forces(packing);
  Mat<2> moments = Mat<2>::Zero();
  for (int i = 0; i < 2; ++i) moments += net.force[i] * packing.grains.position[i].transpose();
  const Mat<2> difference = static_stress(packing) - boundary_stress(packing) - moments / 100.0;
  EXPECT_NEAR(difference.norm(), 0.0, 1e-15);
}

TEST(NetForces, AGrainTouchingItsOwnImageIsInBalanceAndCarriesStress) {
  Packing<2> packing;
  packing.cell.matrix << 1.9, 0.0, 0.0, 5.0;
  packing.grains = Grains<2>::with_size(1);
  packing.grains.radius = {1.0};
  Contact<2> c;
  c.image = {1, 0};
  c.gap = -0.1;
  c.normal = {1.0, 0.0};
  c.arm_i = {0.95, 0.0};
  c.arm_j = {-0.95, 0.0};
  c.normal_force = 2.0;
  packing.contacts = {c};
  EXPECT_EQ(net_forces(packing).force[0].norm(), 0.0);
  EXPECT_NEAR(static_stress(packing)(0, 0), 2.0 * 1.9 / 9.5, 1e-15);
}

TEST(MeanKineticEnergy, CountsTranslationsAndSpins) {
  Packing<2> packing = two_disks();
  packing.grains.velocity[0] = {3.0, 4.0};
  packing.grains.angular_velocity[1][0] = 2.0;
  // The moment of inertia of a disk is m R^2/2 = 0.125.
  EXPECT_DOUBLE_EQ(mean_kinetic_energy(packing), (0.5 * 4 * 25 + 0.5 * 0.125 * 4) / 2);
  Packing<3> ball;
  ball.grains = Grains<3>::with_size(1);
  ball.grains.radius = {0.5};
  ball.grains.mass = {10.0};
  ball.grains.angular_velocity[0] = {0.0, 1.0, 2.0};
  // The moment of inertia of a sphere is 2 m R^2/5 = 1.
  EXPECT_DOUBLE_EQ(mean_kinetic_energy(ball), 2.5);
}

TEST(SolidFraction, IsAreaOrVolumeOfTheGrainsOverThatOfTheCell) {
  EXPECT_DOUBLE_EQ(solid_fraction(two_disks()), 3.14159265358979323846 * 1.25 / 100);
  Packing<3> ball;
  ball.cell.matrix *= 2.0;
  ball.grains = Grains<3>::with_size(1);
  ball.grains.radius = {1.0};
  EXPECT_DOUBLE_EQ(solid_fraction(ball), 3.14159265358979323846 / 6);
}

}  // namespace
}  // namespace floc
