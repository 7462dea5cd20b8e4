#include "floc/rigid/least_volume.h"

#include <gtest/gtest.h>

#include "floc/base/random.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/shape/generators.h"
#include "support/rigid_gas.h"

namespace floc::test {
namespace {

constexpr double kPressure = 2.0;

/// Returns one box in a periodic cell. The box is turned by a small angle, and there are gaps between it and its six
/// neighbours.
Packing<3> one_box(const Vec<3>& sides, double angle) {
  Packing<3> packing;
  packing.law = rigid_law(0.0);
  packing.cell.matrix = (1.05 * sides).asDiagonal();
  packing.grains = Grains<3>::with_size(1);
  const Shape<3> shape = box<3>(sides, 0.0);
  set_shape(packing.grains, shape, sides.norm() / shape.diameter());
  packing.grains.orientation.assign(
      1, Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec<3>(1.0, 2.0, 3.0).normalized())));
  return packing;
}

TEST(LeastVolume, OfOneBoxIsItsVolume) {
  const Vec<3> sides(1.0, 0.8, 0.6);
  Packing<3> packing = one_box(sides, 0.02);
  const LeastVolume found = minimise_volume(packing, pressure_on_all_sides(kPressure), 1e-6);
  ASSERT_EQ(found.failure, "");
  EXPECT_NEAR(packing.cell.volume(), sides.prod(), 1e-9);
  EXPECT_NEAR(solid_fraction(packing), 1.0, 1e-9);
  // Each pair of faces bears the pressure.
  Vec<3> force = Vec<3>::Zero();
  for (const Contact<3>& c : packing.contacts) force += c.normal_force * c.normal.cwiseAbs();
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(force[a], kPressure * sides.prod() / sides[a], 1e-4);
}

TEST(LeastVolume, BalancesAllGrains) {
  const RigidEnd<3> end =
      relaxed<3>(make_rigid_gas<3>({.count = 12, .shape = ShapeOptions{.kind = CutOptions{}}}));
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
  RandomStream random(1, 1);
  for (int trial = 0; trial < 3; ++trial) {
    Packing<3> packing = end.packing;
    for (Vec<3>& x : packing.grains.position)
      for (double& c : x) c += random.uniform(-0.01, 0.01);
    const LeastVolume found = minimise_volume(packing, pressure_on_all_sides(kPressure), 1e-6);
    ASSERT_EQ(found.failure, "");
    // The force of a pair is divided equally among its points, so that net forces balance, but moments do not.
    double mean = 0.0;
    for (const Contact<3>& c : packing.contacts)
      mean += c.normal_force / static_cast<double>(packing.contacts.size());
    for (const Vec<3>& net : net_forces(packing).force) EXPECT_LT(net.norm(), 1e-5 * mean);
    for (const Contact<3>& c : packing.contacts) EXPECT_GT(c.gap, 0.0);
  }
}

TEST(LeastVolume, SaysWhyThereIsNone) {
  Packing<3> packing = one_box(Vec<3>::Ones(), 0.0);
  packing.cell.matrix *= 0.3;
  EXPECT_EQ(minimise_volume(packing, pressure_on_all_sides(kPressure), 1e-6).failure,
            "some grains overlap by more than half their size");
}

}  // namespace
}  // namespace floc::test
