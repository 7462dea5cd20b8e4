#include <gtest/gtest.h>

#include <limits>

#include "floc/packing/balance.h"
#include "floc/packing/wall_forces.h"
#include "support/foreign_packing.h"

/// Tests of packings with weight, walls and free ends.
namespace floc {
namespace {

/// Checks that the net forces contain the weight. Also checks an identity for any net forces: the stress from the
/// boundary minus the stress from the contacts is the contribution of the net forces on the grains.
template <int Dim>
void expect_identity(const test::Ends<Dim>& ends) {
  Packing<Dim> p = test::packing_with_forces<Dim>(ends).packing;
  const Balance<Dim> without = net_forces(p);
  for (int a = 0; a < Dim; ++a) p.gravity[a] = 3.0 + a;
  const Balance<Dim> with = net_forces(p);
  Mat<Dim> difference = Mat<Dim>::Zero();
  double largest = 0.0;
  for (int i = 0; i < p.grains.size(); ++i) {
    EXPECT_NEAR((with.force[i] - without.force[i] - p.grains.mass[i] * p.gravity).norm(), 0.0, 1e-12);
    difference += with.force[i] * p.grains.position[i].transpose();
    largest = std::max(largest, with.force[i].norm());
  }
  const Mat<Dim> expected = static_stress(p) - difference / p.cell.volume();
  EXPECT_NEAR((boundary_stress(p) - expected).norm(), 0.0, 1e-12 * largest);
}

TEST(Gravity, IsABodyForceInBalanceAndBoundaryStress) {
  for (const std::string x : {"p", "ww", "oo"})
    for (const std::string y : {"p", "ww", "wo", "ow"}) {
      expect_identity<2>({x, y});
      expect_identity<3>({x, "p", y});
    }
}

TEST(OpenEnds, BearNoForceAndOneWallBearsItAlone) {
  const Packing<2> p = test::packing_with_forces<2>({"oo", "wo"}).packing;
  const std::vector<double> forces = wall_forces(p);
  EXPECT_EQ(forces[0], 0.0);
  EXPECT_EQ(forces[1], 0.0);
  EXPECT_GT(forces[2], 0.0);
  EXPECT_EQ(forces[3], 0.0);
  EXPECT_NEAR(wall_pressure(p)[1], forces[2] / wall_area(p, 1), 1e-15 * forces[2]);
  EXPECT_EQ(wall_pressure(p)[0], 0.0);
  EXPECT_EQ(mean_wall_pressure(p), wall_pressure(p)[1]) << "an axis that is open at both ends has no walls";
  EXPECT_EQ(mean_wall_pressure(test::packing_with_forces<2>({"oo", "p"}).packing), std::nullopt);
  EXPECT_EQ(load_stress(p)(1, 1), wall_pressure(p)[1]);
  EXPECT_EQ(load_stress(p)(0, 0), static_stress(p)(0, 0));
  EXPECT_TRUE(is_open(p.walls));
  EXPECT_TRUE(is_open_along(p.walls, 0));
  EXPECT_TRUE(is_open_along(p.walls, 1));
  for (const Contact<2>& c : p.contacts) EXPECT_FALSE(p.is_wall(c.j) && p.wall(c.j).open);
}

}  // namespace
}  // namespace floc
