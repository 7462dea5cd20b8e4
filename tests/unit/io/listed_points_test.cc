#include "floc/io/listed_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "floc/packing/locate.h"
#include "floc/shape/generators.h"
#include "support/few_grains.h"
#include "support/rigid_states.h"

namespace floc {
namespace {

/// Returns two squares side by side, of which one is tilted, so that their two contact points have different gaps.
/// @param turns  number of quarter turns of each square; it decides which of their sides meet
/// @param tilt   rotation of each square in addition
Packing<2> two_squares(const std::array<int, 2>& turns, const std::array<double, 2>& tilt) {
  Packing<2> packing = test::unit_grains<2>({{1.0, 1.0}, {1.71, 1.1}}, 4.0, test::rigid_law(0.5));
  Grains<2>& grains = packing.grains;
  grains.shapes = std::make_shared<const std::vector<Shape<2>>>(1, regular_polygon(4, 0.0));
  grains.shape = {0, 0};
  grains.scale.assign(2, 0.5 / grains.shapes->front().outer_radius);
  for (int k : {0, 1}) grains.orientation[k] = (turns[k] + 0.5) * std::numbers::pi / 2.0 + tilt[k];
  return packing;
}

TEST(ListedPoints, HaveTheGapsOfTheirOwnPointsWhicheverSidesMeet) {
  // A contact without a key has the key 0, which is also the key of a point of two sides with the index 0.
  int n_with_key_0 = 0;
  for (const std::array<double, 2>& tilt : {std::array{0.01, 0.0}, {-0.01, 0.0}, {0.0, 0.01}, {0.0, -0.01}})
    for (int first = 0; first < 4; ++first)
      for (int second = 0; second < 4; ++second) {
        const Packing<2> packing = two_squares({first, second}, tilt);
        Contact<2> contact;
        contact.i = 0;
        contact.j = 1;
        const Manifold<2> manifold = manifold_of(packing, contact, branch(packing, contact), 0.1);
        ASSERT_EQ(manifold.n(), 2);
        ASSERT_GT(std::abs(manifold.points[0].gap - manifold.points[1].gap), 1e-3);
        n_with_key_0 += manifold.with_key(0) != nullptr;
        for (const ManifoldPoint<2>& point : manifold.points) {
          ListedContact row;
          row.point.emplace(0.0, 0.0, 0.0);
          row.point->head<2>() = packing.grains.position[0] + point.arm;
          Contact<2> placed = contact;
          place_point(row, false, packing, placed);
          EXPECT_NEAR(placed.gap, point.gap, 1e-12) << first << " " << second << " " << tilt[0];
        }
      }
  EXPECT_GT(n_with_key_0, 0);
}

}  // namespace
}  // namespace floc
