#include "floc/structure/axis_profile.h"

#include <gtest/gtest.h>

#include "floc/packing/balance.h"
#include "support/foreign_packing.h"

namespace floc {
namespace {

TEST(AxisProfile, StressesOfSlicesHaveTheMeanOfThePacking) {
  for (const std::string x : {"p", "ww", "oo"})
    for (const std::string z : {"p", "ww", "wo"})
      for (int axis = 0; axis < 3; ++axis)
        for (const int n : {1, 7, 40}) {
          const Packing<3> p = test::packing_with_forces<3>({x, "p", z}).packing;
          Vec<3> mean = Vec<3>::Zero();
          for (const ProfileSlice& slice : axis_profile(p, axis, n, {}))
            for (int a = 0; a < 3; ++a) mean[a] += slice.stress[static_cast<std::size_t>(a)] / n;
          const Vec<3> expected = static_stress(p).diagonal();
          EXPECT_NEAR((mean - expected).norm(), 0.0, 1e-12 * expected.norm());
        }
}

/// Disks in a column on a floor. Between the centres of two disks, the stress is the weight of the disks above, divided
/// by the width of the cell.
TEST(AxisProfile, StressOfAColumnIsTheWeightAboveOverItsWidth) {
  constexpr int kDisks = 8;
  constexpr double kWeight = 2.0;
  Packing<2> p;
  p.law = parse_law("law", "normal.stiffness=1e6");
  p.wall_law = p.law;
  p.grains = Grains<2>::with_size(kDisks);
  for (int i = 0; i < kDisks; ++i) {
    p.grains.position[i] = {0.5, i + 0.5};
    p.grains.radius[i] = 0.5;
    p.grains.mass[i] = kWeight;
    Contact<2> c;
    c.i = i, c.j = i + 1;
    if (i + 1 == kDisks) c.i = 0, c.j = kDisks;
    c.normal = {0.0, i + 1 == kDisks ? -1.0 : 1.0};
    c.normal_force = kWeight * (i + 1 == kDisks ? kDisks : kDisks - 1 - i);
    p.contacts.push_back(c);
  }
  p.cell.matrix << 1.25, 0.0, 0.0, kDisks;
  p.gravity = {0.0, -1.0};
  p.walls = {{1, -1, 0.0, 0.0, 1.0, false}, {1, 1, kDisks, 0.0, 1.0, true}};
  const std::vector<ProfileSlice> slices = axis_profile(p, 1, 2 * kDisks, {});
  for (int k = 0; k < 2 * kDisks; ++k) {
    const int n_above = kDisks - (k + 1) / 2;  // number of disks whose centres are above the slice
    EXPECT_NEAR(slices[static_cast<std::size_t>(k)].stress[1], kWeight * n_above / 1.25, 1e-12) << k;
    EXPECT_EQ(slices[static_cast<std::size_t>(k)].stress[0], 0.0);
  }
  for (const Vec<2>& force : net_forces(p).force) EXPECT_NEAR(force.norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace floc
