#include <gtest/gtest.h>

#include "floc/shape/manifold.h"
#include "unit/shape/placed.h"
#include "unit/shape/solids.h"

/// Pairs of shapes whose contact points have closed forms.
namespace floc {
namespace {

using namespace test;

/// Requires that a contact has the given points, all with the gap `gap`. Also requires this after a common rotation of
/// both shapes, and after an exchange of the shapes.
template <int Dim>
void expect_everywhere(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second, double gap,
                       const std::vector<Vec<Dim>>& points) {
  RandomStream random(29, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const Mat<Dim> all = trial == 0 ? Mat<Dim>(Mat<Dim>::Identity()) : random_turn<Dim>(random);
    const auto turned = [&](PlacedShape<Dim> one) {
      one.position = (all * one.position).eval();
      one.rotation = (all * one.rotation).eval();
      return one;
    };
    const PlacedShape<Dim> a = turned(trial % 2 ? second : first), b = turned(trial % 2 ? first : second);
    const Manifold<Dim> contact = contact_manifold<Dim>(a, b, 0.1);
    std::vector<Vec<Dim>> found = positions(contact, a);
    for (Vec<Dim>& x : found) x = (all.transpose() * x).eval();
    expect_points<Dim>(found, points);
    for (int k = 0; k < contact.n(); ++k) EXPECT_NEAR(contact.points[k].gap, gap, kExact);
  }
}

TEST(Manifold, OfTheDesignHasItsPointsAtAnyRotationAndInBothOrders) {
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1)), plate = shape_of<3>(box_points(6, 6, 2)),
                 tetrahedron = shape_of<3>(tetrahedron_points());
  expect_everywhere<3>(placed<3>(cube, Vec<3>::Zero(), kNoTurn), placed<3>(cube, {0.25, 0.1, 1.001}, kNoTurn),
                       1e-3,
                       {{-0.25, -0.4, 0.5005}, {0.5, -0.4, 0.5005}, {-0.25, 0.5, 0.5005}, {0.5, 0.5, 0.5005}});
  for (const double sign : {-1.0, 1.0}) {
    const Mat<3> turn =
        Eigen::Quaterniond::FromTwoVectors(Vec<3>(1, 1, 1), Vec<3>(0, 0, sign)).toRotationMatrix();
    const double height = (sign < 0 ? std::sqrt(3.0) : 1.0 / std::sqrt(3.0)) + 0.01;
    std::vector<Vec<3>> points;
    for (const Vec<3>& v : tetrahedron_points())
      if (const Vec<3> x = turn * v; x[2] < 0.0) points.emplace_back(x[0], x[1], 0.005);
    EXPECT_EQ(points.size(), sign < 0 ? 1u : 3u);
    expect_everywhere<3>(placed<3>(plate, {0, 0, -1}, kNoTurn), placed<3>(tetrahedron, {0, 0, height}, turn),
                         0.01, points);
  }
  const double degree = std::numbers::pi / 180.0, half_side = std::sin(36.0 * degree),
               inner = std::cos(36.0 * degree);
  const Shape<2> pentagon = shape_of<2>(polygon_points(5)),
                 triangle = shape_of<2>({{0, 0}, {5, 0}, {3.2, 2.4}});
  const auto above = placed<2>(pentagon, {0, 0}, Mat<2>::Identity());
  const double gap = 1.62 - 2.0 * inner, y = -0.5 * 1.62;
  expect_everywhere<2>(above, placed<2>(pentagon, {0.3, -1.62}, turn_by(180.0)), gap,
                       {{0.3 - half_side, y}, {half_side, y}});
  expect_everywhere<2>(above, placed<2>(pentagon, {0.1, -1.85}, Mat<2>::Identity()), 0.85 - inner,
                       {{0.1, 0.5 * (-0.85 - inner)}});
  expect_everywhere<2>(placed<2>(triangle, {0, 0}, Mat<2>::Identity()),
                       placed<2>(triangle, {5.5, -0.01}, turn_by(180.0)), 0.01, {{0.5, -0.005}, {5.0, -0.005}});
}

}  // namespace
}  // namespace floc
