#include "floc/packing/equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/contact_laws.h"

namespace floc {
namespace {

/// One disk of radius 1 compressed between its own images in a 1.9 x 1.9 cell, with F_N = 2. The stress on both
/// axes is 2 x 1.9/1.9^2.
Packing<2> squeezed() {
  Packing<2> packing;
  packing.cell.matrix *= 1.9;
  packing.law += test::linear(20.0);
  packing.grains = Grains<2>::with_size(1);
  packing.grains.radius = {1.0};
  packing.grains.mass = {3.0};
  for (const int axis : {0, 1}) {
    Contact<2> c;
    c.image[axis] = 1;
    c.normal[axis] = 1.0;
    c.gap = -0.1;
    c.normal_force = 2.0;
    packing.contacts.push_back(c);
  }
  return packing;
}

const Vec<2> kStress(2 / 1.9, 2 / 1.9);

TEST(ForceScale, IsTheLargerOfPullOffForceAndPressureOnAGrain) {
  Packing<2> packing = squeezed();
  EXPECT_DOUBLE_EQ(force_scale(packing, Vec<2>(1.0, 3.0)).force, 2.0 * 2.0);
  EXPECT_EQ(force_scale(packing, Vec<2>(1.0, 3.0)).length, 2.0);
  packing.law += test::constant_adhesion(5.0);
  EXPECT_EQ(force_scale(packing, Vec<2>(1.0, 3.0)).force, 5.0);
  EXPECT_DOUBLE_EQ(force_scale(packing, Vec<2>(10.0, 10.0)).force, 20.0);
}

TEST(ForceScale, In3DIsPressureOnTheSquareOfTheDiameter) {
  Packing<3> packing;
  packing.grains = Grains<3>::with_size(2);
  packing.grains.radius = {0.5, 1.5};
  EXPECT_DOUBLE_EQ(force_scale(packing, Vec<3>(2.0, 2.0, 2.0)).force, 2.0 * 9.0);
}

/// Returns the residuals of squeezed() with two additional disks, which touch each other. The contact of these two
/// disks has a normal force of 0.5 and a tangential force of 0.1, which causes moments.
/// @param smallest  radius of the last disk
/// @param change    change of the packing before the residuals are computed
template <class Change>
Residuals with_sizes(double smallest, const Change& change) {
  Packing<2> packing = squeezed();
  packing.grains = Grains<2>::with_size(3);
  packing.grains.radius = {1.0, 1.0, smallest};
  packing.grains.mass = {1.0, 1.0, 1.0};
  Contact<2> c;
  c.i = 1, c.j = 2;
  c.normal = {0.0, 1.0};
  c.arm_i = {0.0, 1.0};
  c.arm_j = {0.0, -smallest};
  c.normal_force = 0.5;
  c.shear_force = {0.1, 0.0};
  packing.contacts.push_back(c);
  change(packing);
  return residuals(packing, kStress);
}

TEST(Residuals, OfGrainsUpToFourTimesAsLargeAsOthersShareTheScaleOfTheLargest) {
  const Residuals r = with_sizes(0.25, [](Packing<2>& p) { p.grains.velocity[2] = {2.0, 0.0}; });
  const double f1 = kStress.mean() * 2.0;
  EXPECT_DOUBLE_EQ(r.force, std::hypot(0.5, 0.1) / f1);
  EXPECT_EQ(r.worst_force_grain, 1);
  EXPECT_DOUBLE_EQ(r.moment, 0.1 / (f1 * 2.0));
  EXPECT_EQ(r.worst_moment_grain, 1);
  EXPECT_DOUBLE_EQ(r.energy, 0.5 * 4.0 / 3 / (f1 * 2.0));
}

TEST(Residuals, OfGrainsMoreDifferentThanThatAreByTheirOwn) {
  const Residuals r = with_sizes(0.1, [](Packing<2>& p) { p.grains.velocity[2] = {2.0, 0.0}; });
  const double small_f1 = kStress.mean() * 0.2;
  EXPECT_DOUBLE_EQ(r.force, std::hypot(0.5, 0.1) / small_f1);
  EXPECT_EQ(r.worst_force_grain, 2);
  EXPECT_DOUBLE_EQ(r.moment, 0.1 * 0.1 / (small_f1 * 0.2));
  EXPECT_EQ(r.worst_moment_grain, 2);
  EXPECT_DOUBLE_EQ(r.energy, 0.5 * 4.0 / 3 / (small_f1 * 0.2));
}

TEST(Residuals, WithAdhesionNoGrainIsHeldToLessThanThePullOffForce) {
  const Residuals r = with_sizes(0.1, [](Packing<2>& p) { p.law += test::constant_adhesion(1.5); });
  EXPECT_DOUBLE_EQ(r.force, std::hypot(0.5, 0.1) / 1.5);
  EXPECT_EQ(r.worst_force_grain, 2);
}

TEST(Residuals, OfABalancedDiskVanish) {
  const Residuals r = residuals(squeezed(), kStress);
  EXPECT_EQ(r.force, 0.0);
  EXPECT_EQ(r.moment, 0.0);
  EXPECT_NEAR(r.stress, 0.0, 1e-15);
  EXPECT_EQ(r.energy, 0.0);
  EXPECT_TRUE(r.within(EquilibriumTolerance{}));
}

TEST(Residuals, AreInUnitsOfTheForceScaleAndNameTheWorstGrain) {
  Packing<2> packing = squeezed();
  packing.grains = Grains<2>::with_size(3);
  packing.grains.radius = {1.0, 1.0, 0.5};
  packing.grains.mass = {1.0, 1.0, 1.0};
  packing.grains.velocity[0] = {2.0, 0.0};
  Contact<2> c;
  c.i = 1;
  c.j = 2;
  c.normal = {0.0, 1.0};
  c.arm_i = {0.0, 1.0};
  c.arm_j = {0.0, -0.5};
  c.normal_force = 0.5;
  c.shear_force = {0.1, 0.0};
  packing.contacts.push_back(c);
  packing.grains.position[1] = {0.0, 0.2};
  packing.grains.position[2] = {0.0, 0.2};  // the branch is now zero, so the contact adds nothing to the stress
  const Residuals r = residuals(packing, kStress);
  const double f1 = 2 / 1.9 * 2.0;
  EXPECT_NEAR(r.force, std::hypot(0.5, 0.1) / f1, 1e-15);
  EXPECT_NEAR(r.moment, 1.0 * 0.1 / (f1 * 2.0), 1e-15);
  EXPECT_EQ(r.worst_force_grain, 1);
  EXPECT_EQ(r.worst_moment_grain, 1);
  EXPECT_NEAR(r.energy, 0.5 * 4.0 / 3 / (f1 * 2.0), 1e-15);
  EXPECT_NEAR(r.stress, 0.0, 1e-15);
}

TEST(Residuals, StressIsTheLargestDifferenceOfADiagonalComponent) {
  const Vec<2> target = kStress + Vec<2>(0.01, -0.03);
  const double f1 = target.mean() * 2.0;
  EXPECT_NEAR(residuals(squeezed(), target).stress, 0.03 / (f1 / 2.0), 1e-15);
}

TEST(Residuals, WithoutAForceScaleAnythingButZeroIsInfinite) {
  Packing<2> packing = squeezed();
  const Residuals loaded = residuals(packing, Vec<2>(Vec<2>::Zero()));
  EXPECT_EQ(loaded.force, 0.0);
  EXPECT_TRUE(std::isinf(loaded.stress));
  packing.contacts.clear();
  EXPECT_EQ(residuals(packing, Vec<2>(Vec<2>::Zero())).stress, 0.0);
}

TEST(EquilibriumTolerance, EachOfTheFourCriteriaCanFailAlone) {
  const EquilibriumTolerance t;
  const auto below = [&] {
    Residuals r;
    r.force = t.force / 2, r.moment = t.moment / 2, r.stress = t.stress / 2, r.energy = t.energy / 2;
    return r;
  };
  EXPECT_TRUE(below().within(t));
  for (double Residuals::*which :
       {&Residuals::force, &Residuals::moment, &Residuals::stress, &Residuals::energy}) {
    Residuals r = below();
    r.*which *= 2.5;
    EXPECT_FALSE(r.within(t));
    r.*which = std::nan("");
    EXPECT_FALSE(r.within(t));
  }
}

}  // namespace
}  // namespace floc
