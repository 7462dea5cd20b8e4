#include "floc/io/listed_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "floc/base/random.h"
#include "floc/packing/locate.h"
#include "floc/packing/rotation.h"
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

/// Returns two boxes of length 1, twelve times as long as wide, that touch in random positions.
/// @param cell  lattice vectors (rows)
template <int Dim>
Packing<Dim> two_rods(const Mat<Dim>& cell, RandomStream& random) {
  Packing<Dim> packing =
      test::unit_grains<Dim>({Vec<Dim>::Zero(), Vec<Dim>::Zero()}, 1.0, test::rigid_law(0.5));
  packing.cell.matrix = cell;
  Vec<Dim> sides = Vec<Dim>::Ones();
  sides[0] = 12.0;
  Grains<Dim>& grains = packing.grains;
  grains.shapes = std::make_shared<const std::vector<Shape<Dim>>>(1, box<Dim>(sides, 0.0));
  grains.shape = {0, 0};
  grains.scale.assign(2, 0.5 / grains.shapes->front().outer_radius);
  const auto random_turn = [&] {
    RotationVector<Dim> turn;
    for (double& component : turn.reshaped()) component = random.uniform(-3.0, 3.0);
    return turn;
  };
  for (int k : {0, 1}) grains.orientation[k] = turned(no_rotation<Dim>(), random_turn());
  Vec<Dim> direction;
  for (double& component : direction) component = random.normal();
  direction.normalize();
  double touching = 0.0, apart = 1.01;
  while (apart - touching > 1e-14) {
    const double middle = (touching + apart) / 2.0;
    grains.position[1] = middle * direction;
    Contact<Dim> contact;
    contact.i = 0;
    contact.j = 1;
    (manifold_of(packing, contact, branch(packing, contact), 0.1).least_gap() > 0.0 ? apart : touching) =
        middle;
  }
  return packing;
}

/// Places the contact points of two rods that are given at an image of themselves, and expects their arms.
/// @return number of points further than half the cell from the centre of a rod along a lattice vector
template <int Dim>
int check_points_of_rods(const Mat<Dim>& cell, const Vec<Dim, int>& image, RandomStream& random) {
  const Packing<Dim> packing = two_rods<Dim>(cell, random);
  Contact<Dim> contact;
  contact.i = 0;
  contact.j = 1;
  int n_far = 0;
  for (const ManifoldPoint<Dim>& point : manifold_of(packing, contact, branch(packing, contact), 1e-3).points) {
    ListedContact row;
    row.point.emplace(0.0, 0.0, 0.0);
    row.point->template head<Dim>() = packing.grains.position[0] + point.arm + packing.cell.shift(image);
    Contact<Dim> placed = contact;
    place_point(row, false, packing, placed);
    EXPECT_LT((placed.arm_i - point.arm).norm(), 1e-12) << image.transpose() << "\n" << cell;
    EXPECT_LT((placed.arm_j - (point.arm - branch(packing, contact))).norm(), 1e-12);
    n_far += packing.cell.reduced(point.arm).cwiseAbs().maxCoeff() > 0.5;
  }
  return n_far;
}

TEST(ListedPoints, KeepTheirPlacesOnRodsAboutAsLongAsTheCell) {
  RandomStream random(1, 1);
  int n_far_2d = 0, n_far_3d = 0;
  for (int k = 0; k < 200; ++k) {
    // Cells from 0.7 to 1.3 lengths, and skewed by up to one and a half of them.
    const double side = random.uniform(0.7, 1.3), skew = random.uniform(-1.5, 1.5) * side;
    Mat<2> plane;
    plane << side, 0.0, skew, side;
    Mat<3> space;
    space << side, 0.0, 0.0, skew, side, 0.0, 0.0, -skew, side;
    for (int a = -1; a <= 1; ++a) {
      n_far_2d += check_points_of_rods<2>(plane, {a, -a}, random);
      n_far_3d += check_points_of_rods<3>(space, {a, 1, -a}, random);
    }
  }
  EXPECT_GT(n_far_2d, 20);
  EXPECT_GT(n_far_3d, 20);
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
