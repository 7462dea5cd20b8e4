#include "floc/shape/manifold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "floc/shape/closest_points.h"
#include "floc/shape/generators.h"
#include "unit/shape/pairs.h"
#include "unit/shape/placed.h"
#include "unit/shape/solids.h"

namespace floc {
namespace {

using namespace test;

TEST(Manifold, OfShiftedCubesHasTheCornersOfTheirOverlap) {
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1));
  const auto below = placed<3>(cube, Vec<3>::Zero(), kNoTurn),
             above = placed<3>(cube, {0.25, 0.1, 1.001}, kNoTurn);
  const Manifold<3> contact = contact_manifold<3>(below, above, 0.01);
  expect_points<3>(positions(contact, below),
                   {{-0.25, -0.4, 0.5005}, {0.5, -0.4, 0.5005}, {-0.25, 0.5, 0.5005}, {0.5, 0.5, 0.5005}});
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(contact.points[k].gap, 1e-3, kExact);
  EXPECT_NEAR((contact.normal - Vec<3>::UnitZ()).norm(), 0.0, kExact);
  EXPECT_EQ(contact.type, ContactType::kFaceFace);
  EXPECT_EQ(contact_manifold<3>(below, above, 1e-4).n(), 0);
}

TEST(Manifold, OfCubesTurnedBy45DegreesHasAllCornersOfTheOctagon) {
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1));
  const auto below = placed<3>(cube, Vec<3>::Zero(), kNoTurn);
  const auto above = placed<3>(cube, {0, 0, 0.999}, turn_about(Vec<3>::UnitZ(), 45.0));
  const Manifold<3> contact = contact_manifold<3>(below, above, 0.01);
  ASSERT_EQ(contact.n(), 8);
  const double s = 0.5 * std::tan(std::numbers::pi / 8.0);  // 0.2071
  std::vector<double> angles;
  for (const Vec<3>& p : positions(contact, below)) {
    EXPECT_NEAR(std::max(std::abs(p[0]), std::abs(p[1])), 0.5, kExact);
    EXPECT_NEAR(std::min(std::abs(p[0]), std::abs(p[1])), s, kExact);
    EXPECT_NEAR(p[2], 0.4995, kExact);
    angles.push_back(std::atan2(p[1], p[0]));
  }
  // The two squares intersect in a regular octagon.
  std::sort(angles.begin(), angles.end());
  for (int k = 0; k < 7; ++k) EXPECT_NEAR(angles[k + 1] - angles[k], 0.25 * std::numbers::pi, 1e-12);
}

TEST(Manifold, OfCrossedEdgesIsOnePoint) {
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1));
  RandomStream random(1, 1);
  for (const double z : {1.41, std::numbers::sqrt2, 1.42})
    for (const double degrees : {0.0, 30.0})
      for (int trial = 0; trial < 10; ++trial) {
        // The upper edge lies along y, or at an angle of 60 degrees to the lower edge.
        const Mat<3> all = trial == 0 ? kNoTurn : random_turn<3>(random);
        const Mat<3> upper = turn_about(Vec<3>::UnitZ(), -degrees) * turn_about(Vec<3>::UnitY(), 45.0);
        const Vec<3> centre(0.1, 0.2, z);
        const auto a = placed<3>(cube, Vec<3>::Zero(), all * turn_about(Vec<3>::UnitX(), 45.0));
        const auto b = placed<3>(cube, all * centre, all * upper);
        const Manifold<3> contact = contact_manifold<3>(a, b, 0.1);
        ASSERT_EQ(contact.n(), 1);
        EXPECT_EQ(contact.type, ContactType::kEdgeEdge);
        EXPECT_NEAR(contact.points[0].gap, z - std::numbers::sqrt2, kExact);
        // The line of the upper edge through (0.1, 0.2) intersects y = 0 at this x.
        const double x = 0.1 - 0.2 * std::tan(degrees * std::numbers::pi / 180.0);
        EXPECT_NEAR((all.transpose() * contact.points[0].arm - Vec<3>(x, 0, 0.5 * z)).norm(), 0.0, 2e-13);
        EXPECT_NEAR((all.transpose() * contact.normal - Vec<3>::UnitZ()).norm(), 0.0, kExact);
      }
}

TEST(Manifold, OfATetrahedronOnAFaceHasOnePointOrThree) {
  const Shape<3> plate = shape_of<3>(box_points(6, 6, 2)), tetrahedron = shape_of<3>(tetrahedron_points());
  const auto floor = placed<3>(plate, {0, 0, -1}, kNoTurn);
  // The corner (1, 1, 1) points down, then up.
  for (const double sign : {-1.0, 1.0}) {
    const Mat<3> turn =
        Eigen::Quaterniond::FromTwoVectors(Vec<3>(1, 1, 1), Vec<3>(0, 0, sign)).toRotationMatrix();
    const double lowest = sign < 0 ? std::sqrt(3.0) : 1.0 / std::sqrt(3.0);
    for (const double gap : {-0.01, 0.0, 0.01}) {
      const auto stone = placed<3>(tetrahedron, {0.3, -0.2, lowest + gap}, turn);
      const Manifold<3> contact = contact_manifold<3>(floor, stone, 0.1);
      ASSERT_EQ(contact.n(), sign < 0 ? 1 : 3);
      EXPECT_EQ(contact.type, sign < 0 ? ContactType::kVertexFace : ContactType::kFaceFace);
      for (int k = 0; k < contact.n(); ++k) EXPECT_NEAR(contact.points[k].gap, gap, kExact);
    }
  }
}

TEST(Manifold, OfPentagonsHasSidesOrAVertex) {
  const Shape<2> pentagon = shape_of<2>(polygon_points(5));
  const double degree = std::numbers::pi / 180.0;
  const auto a = placed<2>(pentagon, Vec<2>::Zero(), Mat<2>::Identity());
  // Side on side: the second pentagon lies below the first and is rotated by 180 degrees.
  for (const double shift : {-0.3, 0.0, 0.4})
    for (const double r : {1.61, 1.62}) {
      const auto b = placed<2>(pentagon, {shift, -r}, turn_by(180.0));
      const Manifold<2> contact = contact_manifold<2>(a, b, 0.1);
      ASSERT_EQ(contact.n(), 2);
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(contact.points[k].gap, r - 2.0 * std::cos(36.0 * degree), kExact);
      EXPECT_NEAR((contact.points[0].arm - contact.points[1].arm).norm(),
                  2.0 * std::sin(36.0 * degree) - std::abs(shift), kExact);
      EXPECT_EQ(contact.type, ContactType::kFaceFace);
    }
  const auto below = placed<2>(pentagon, {0.1, -1.9}, Mat<2>::Identity());
  const Manifold<2> contact = contact_manifold<2>(a, below, 0.2);
  ASSERT_EQ(contact.n(), 1);
  EXPECT_NEAR(contact.points[0].gap, 1.9 - 1.0 - std::cos(36.0 * degree), kExact);
  EXPECT_NEAR(contact.points[0].arm[0], 0.1, kExact);
  EXPECT_NEAR((contact.normal - Vec<2>(0, -1)).norm(), 0.0, kExact);
}

TEST(Manifold, OfTrianglesOnTheirHypotenusesHasTwoPoints) {
  // The hypotenuse of the first triangle runs from (0, 0) to (5, 0), with its third corner above. The second
  // triangle is the first one, rotated by 180 degrees and shifted.
  const Shape<2> triangle = shape_of<2>({{0, 0}, {5, 0}, {3.2, 2.4}});
  const auto a = placed<2>(triangle, Vec<2>::Zero(), Mat<2>::Identity());
  const auto b = placed<2>(triangle, {5.5, -0.01}, turn_by(180.0));
  const Manifold<2> contact = contact_manifold<2>(a, b, 0.1);
  ASSERT_EQ(contact.n(), 2);
  EXPECT_NEAR((contact.points[0].arm - contact.points[1].arm).norm(), 4.5, kExact);
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(contact.points[k].gap, 0.01, kExact);
}

template <int Dim>
void expect_exchange_and_rigid_motions_to_change_nothing(double rounding) {
  RandomStream random(21, 1);
  int n_touching = 0;
  for (int trial = 0; trial < 600; ++trial) {
    RandomPair<Dim> pair(random, rounding);
    pair.set_depth(random, random.uniform(-0.02, 0.02));
    const Manifold<Dim> contact = contact_manifold<Dim>(pair.first(), pair.second(), 0.03);
    const Manifold<Dim> exchanged = contact_manifold<Dim>(pair.second(), pair.first(), 0.03);
    n_touching += contact.n() > 0 ? 1 : 0;
    ASSERT_EQ(contact.n(), exchanged.n()) << trial;
    if (contact.n() == 0) continue;
    // If two normals gave equal gaps within the margin, the order of the shapes would decide between them. These pairs
    // have no such normals, so an exchange of the shapes reverses the normal.
    EXPECT_NEAR((contact.normal + exchanged.normal).norm(), 0.0, 1e-11) << trial;
    EXPECT_NEAR(contact.least_gap(), exchanged.least_gap(), 1e-12) << trial;
    const Mat<Dim> turn = random_turn<Dim>(random);
    const Vec<Dim> shift = 3.0 * random_direction<Dim>(random);
    auto a = pair.first(), b = pair.second();
    for (PlacedShape<Dim>* one : {&a, &b}) {
      one->position = turn * one->position + shift;
      one->rotation = (turn * one->rotation).eval();
    }
    const Manifold<Dim> moved = contact_manifold<Dim>(a, b, 0.03);
    ASSERT_EQ(moved.n(), contact.n());
    EXPECT_NEAR((moved.normal - turn * contact.normal).norm(), 0.0, 1e-11);
    for (int k = 0; k < contact.n(); ++k) {
      EXPECT_NEAR((moved.points[k].arm - turn * contact.points[k].arm).norm(), 0.0, 1e-11);
      EXPECT_NEAR(moved.points[k].gap, contact.points[k].gap, 1e-12);
      EXPECT_EQ(moved.points[k].key, contact.points[k].key);
      double nearest = 1.0;
      for (int l = 0; l < contact.n(); ++l)
        nearest = std::min(nearest, (exchanged.points[l].arm + pair.second().position - contact.points[k].arm -
                                     pair.first().position)
                                        .norm());
      EXPECT_LT(nearest, 1e-11);
    }
  }
  EXPECT_GT(n_touching, 400);
}

TEST(Manifold, IsUnchangedByExchangeAndRigidMotions) {
  for (const double rounding : {0.0, 0.05}) {
    expect_exchange_and_rigid_motions_to_change_nothing<2>(rounding);
    expect_exchange_and_rigid_motions_to_change_nothing<3>(rounding);
  }
}

/// Compares gaps with the largest separation along any direction, which is found by a search that does not use faces
/// and edges.
template <int Dim>
void expect_gaps_of_a_search_over_directions(double rounding) {
  RandomStream random(22, 1);
  for (int trial = 0; trial < (Dim == 2 ? 300 : 150); ++trial) {
    RandomPair<Dim> pair(random, rounding);
    pair.set_true_depth(random, std::pow(10.0, random.uniform(-6.0, -2.0)));
    const Manifold<Dim> contact = contact_manifold<Dim>(pair.first(), pair.second(), 1e-3);
    const double expected = separation_by_search(pair.first(), pair.second());
    ASSERT_GT(contact.n(), 0) << trial;
    // The gap may exceed the result of the search, which may end below the largest separation. The gap may also be
    // smaller by a margin of 1e-4 of the inner radius, if the contact uses a face instead of an edge pair.
    EXPECT_GT(contact.least_gap(), expected - 1e-4 * 0.5) << trial;
    // Along the contact normal, the separation equals the gap. For rounded shapes this is not tested: a face normal may
    // deviate by 1e-3 radians from the line between the closest points, which makes the separation smaller.
    if (rounding == 0.0) {
      EXPECT_NEAR(separation_along(pair.first(), pair.second(), contact.normal), contact.least_gap(), 0.5e-6)
          << trial;
    }
    // A translation of the second shape by the gap along the normal brings the shapes into touch.
    auto moved = pair.second();
    moved.position -= contact.least_gap() * contact.normal;
    const Manifold<Dim> touching = contact_manifold<Dim>(pair.first(), moved, 1e-3);
    ASSERT_GT(touching.n(), 0) << trial;
    EXPECT_NEAR(touching.least_gap(), 0.0, 1e-12) << trial;
  }
}

TEST(Manifold, HasTheDepthOfASearchOverDirections) {
  for (const double rounding : {0.0, 0.05}) {
    expect_gaps_of_a_search_over_directions<2>(rounding);
    expect_gaps_of_a_search_over_directions<3>(rounding);
  }
}

/// Compares the depth of overlapping polyhedra with the largest separation along the normals of all faces and edge
/// pairs. For most pairs of polyhedra, the two agree up to rounding.
TEST(Manifold, OfPolyhedraHasTheDepthOfAllAxes) {
  RandomStream random(28, 1);
  int n_overlapping = 0, n_exact = 0, n_edges = 0;
  for (int trial = 0; trial < 400; ++trial) {
    RandomPair<3> pair(random, 0.0);
    pair.set_depth(random, std::pow(10.0, random.uniform(-6.0, -1.0)));
    const double expected = separation_by_all_axes(pair.first(), pair.second());
    if (expected > 0.0) continue;  // the common normal of an edge pair separates the shapes
    const Manifold<3> contact = contact_manifold<3>(pair.first(), pair.second(), 1.0);
    const double margin = 1e-4 * std::min(pair.first().inner_radius(), pair.second().inner_radius());
    EXPECT_NEAR(contact.least_gap(), expected, margin) << trial;
    ++n_overlapping;
    n_exact += std::abs(contact.least_gap() - expected) < 2e-15 ? 1 : 0;
    n_edges += contact.type == ContactType::kEdgeEdge ? 1 : 0;
  }
  EXPECT_GT(n_overlapping, 100);
  EXPECT_GT(n_exact, 0.97 * n_overlapping);
  EXPECT_GT(n_edges, n_overlapping / 20);
}

/// For separate rounded shapes the gap is the distance.
TEST(Manifold, OfRoundedShapesApartHasTheirDistance) {
  RandomStream random(23, 1);
  for (int trial = 0; trial < 200; ++trial) {
    RandomPair<3> pair(random, 0.1);
    pair.set_true_depth(random, -random.uniform(0.001, 0.05));
    const PlacedShape<3> a = pair.first(), b = pair.second();
    const ClosestPoints<3> closest =
        closest_points<3>(*a.shape, *b.shape, RelativePlace<3>(a, b), Vec<3>::UnitX());
    // The distance of the shapes is at least their separation along any direction, and at most the distance of any two
    // of their points. Here both bounds are equal, so they give the distance.
    const double expected = a.scale * closest.distance - a.rounding() - b.rounding();
    EXPECT_NEAR(separation_along<3>(a, b, a.rotation * closest.normal), expected, 1e-14) << trial;
    EXPECT_NEAR((closest.on_second - closest.on_first - closest.distance * closest.normal).norm(), 0.0, 1e-13);
    // If the contact uses a face, the face normal may deviate by 1e-3 radians from the line between the closest points.
    // This changes the gap by half of the squared deviation times the distance of the cores. Contact points may also
    // lie farther away by 1e-6 of the inner radius.
    const Manifold<3> contact = contact_manifold<3>(a, b, 0.1);
    ASSERT_GT(contact.n(), 0);
    EXPECT_NEAR(contact.least_gap(), expected, 6e-7) << trial;
  }
}

TEST(Manifold, OfBallsAndPolytopesIsTheClosestPoint) {
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1)), ball = round_shape<3>(0.3);
  const auto box = placed<3>(cube, Vec<3>::Zero(), kNoTurn);
  const auto contact_at = [&](const Vec<3>& centre) {
    return contact_manifold<3>(box, PlacedShape<3>{&ball, 1.0, centre, kNoTurn}, 0.05);
  };
  const auto expect = [&](const Vec<3>& centre, const Vec<3>& foot) {
    const Manifold<3> contact = contact_at(centre);
    ASSERT_EQ(contact.n(), 1);
    const Vec<3> n = (centre - foot).normalized();
    const double gap = (centre - foot).norm() - 0.3;
    EXPECT_NEAR((contact.normal - n).norm(), 0.0, kExact);
    EXPECT_NEAR(contact.points[0].gap, gap, kExact);
    EXPECT_NEAR((contact.points[0].arm - (foot + 0.5 * gap * n)).norm(), 0.0, kExact);
  };
  expect({0.1, 0.2, 0.78}, {0.1, 0.2, 0.5});        // face
  expect({0.1, 0.7, 0.71}, {0.1, 0.5, 0.5});        // edge
  expect({-0.65, 0.67, 0.68}, {-0.5, 0.5, 0.5});    // vertex
  expect({0.1, 0.2, 0.5 + 1e-9}, {0.1, 0.2, 0.5});  // the centre is on the surface
  EXPECT_EQ(contact_at({0.1, 0.2, 0.86}).n(), 0);
  const Manifold<3> inside = contact_at({0.1, 0.2, 0.4});
  EXPECT_NEAR(inside.points[0].gap, -0.4, kExact);
  EXPECT_NEAR((inside.normal - Vec<3>::UnitZ()).norm(), 0.0, kExact);
  const Shape<2> disk = round_shape<2>(1.0), side = shape_of<2>(polygon_points(5));
  const PlacedShape<2> one{&disk, 0.5, {0, 0}, Mat<2>::Identity()}, other{&disk, 2.0, {0, 2.4}, turn_by(20)};
  const Manifold<2> disks = contact_manifold<2>(one, other, 0.0);
  ASSERT_EQ(disks.n(), 1);
  EXPECT_NEAR(disks.points[0].gap, -0.1, kExact);
  EXPECT_NEAR((disks.points[0].arm - Vec<2>(0, 0.45)).norm(), 0.0, kExact);
  const Manifold<2> mixed = contact_manifold<2>(one, placed<2>(side, {0, -1.49}, Mat<2>::Identity()), 0.0);
  EXPECT_NEAR(mixed.points[0].gap, -0.01, kExact);
}

TEST(Manifold, OfCapsulesHasOnePointOrTwoSideBySide) {
  const Shape<3> capsule = capsule_shape<3>(2.0, 0.25), floor = shape_of<3>(box_points(6, 6, 1));
  const PlacedShape<3> one{&capsule, 1.0, {0, 0, 0}, kNoTurn};
  const Manifold<3> parallel =
      contact_manifold<3>(one, {&capsule, 1.0, {0.5, 0.49, 0}, turn_about(Vec<3>::UnitZ(), 180)}, 0.01);
  ASSERT_EQ(parallel.n(), 2);
  expect_points<3>(positions(parallel, one), {{-0.5, 0.245, 0}, {1, 0.245, 0}});
  EXPECT_EQ(parallel.type, ContactType::kDouble);
  const Manifold<3> crossed =
      contact_manifold<3>(one, {&capsule, 1.0, {0.5, 0, 0.51}, turn_about(Vec<3>::UnitZ(), 70)}, 0.02);
  ASSERT_EQ(crossed.n(), 1);
  EXPECT_NEAR(crossed.points[0].gap, 0.01, kExact);
  EXPECT_EQ(crossed.type, ContactType::kEdgeEdge);
  const Manifold<3> lying = contact_manifold<3>(placed<3>(floor, {0, 0, -0.5}, kNoTurn),
                                                {&capsule, 1.0, {0, 0, 0.24}, kNoTurn}, 0.01);
  ASSERT_EQ(lying.n(), 2);
  EXPECT_NEAR(lying.least_gap(), -0.01, kExact);
  const Manifold<3> through =
      contact_manifold<3>(one, {&capsule, 1.0, {0, 0, 0}, turn_about(Vec<3>::UnitZ(), 90)}, 0.01);
  EXPECT_NEAR(through.least_gap(), -0.5, kExact);
  const Shape<2> flat = capsule_shape<2>(2.0, 0.25);
  const PlacedShape<2> two{&flat, 1.0, {0, 0}, Mat<2>::Identity()};
  EXPECT_EQ(contact_manifold<2>(two, {&flat, 1.0, {0.5, 0.49}, turn_by(180)}, 0.01).n(), 2);
  const Manifold<2> in_line = contact_manifold<2>(two, {&flat, 1.0, {2.49, 0}, Mat<2>::Identity()}, 0.01);
  ASSERT_EQ(in_line.n(), 1);
  EXPECT_NEAR(in_line.points[0].gap, -0.01, kExact);
}

/// Two capsules are skew by 3.5e-4 radians. As they tilt, the end at which they are closest changes, but the normal and
/// the gaps must change continuously.
TEST(Manifold, NormalOfCapsulesSideBySideDoesNotJump) {
  const Shape<3> capsule = capsule_shape<3>(2.0, 0.25);
  const PlacedShape<3> one{&capsule, 1.0, {0, 0, 0}, kNoTurn};
  const auto tilted = [&](double degrees) {
    const Mat<3> turn = turn_about(Vec<3>::UnitY(), 0.02) * turn_about(Vec<3>::UnitZ(), degrees);
    return contact_manifold<3>(one, {&capsule, 1.0, {0.5, 0.49, 0}, turn}, 0.01);
  };
  const Manifold<3> to_one_side = tilted(1e-6), to_the_other = tilted(-1e-6);
  ASSERT_EQ(to_one_side.n(), 2);
  ASSERT_EQ(to_the_other.n(), 2);
  EXPECT_LT((to_one_side.normal - to_the_other.normal).norm(), 1e-7);
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(to_one_side.points[k].gap, to_the_other.points[k].gap, 1e-7) << k;
}

/// An edge of the upper cube rotates about the vertical axis. At the angle 0, it is parallel to an edge of the lower
/// cube. The gap must change continuously, and must equal the separation of the cubes along the contact normal.
TEST(Manifold, OfEdgesThatTurnThroughParallelIsContinuous) {
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1));
  const auto below = placed<3>(cube, Vec<3>::Zero(), turn_about(Vec<3>::UnitX(), 45.0));
  AxisFeatures last;
  double before = 0.0;
  for (int k = -2000; k <= 2000; ++k) {
    const double degrees = k == 0 ? 0.0 : std::copysign(std::pow(10.0, std::abs(k) * 0.006 - 11.0), k);
    const Mat<3> turn = turn_about(Vec<3>::UnitZ(), degrees) * turn_about(Vec<3>::UnitX(), 45.0);
    const auto above = placed<3>(cube, {0.05, 0.01, std::numbers::sqrt2 - 0.02}, turn);
    for (AxisFeatures* features : {static_cast<AxisFeatures*>(nullptr), &last}) {
      const Manifold<3> contact = contact_manifold<3>(below, above, 0.01, features);
      ASSERT_GT(contact.n(), 0) << degrees;
      ASSERT_TRUE(contact.normal.allFinite());
      EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-12);
      const double expected = separation_along(below, above, contact.normal);
      EXPECT_NEAR(contact.least_gap(), expected, 0.5e-6) << degrees;
      if (features == nullptr) {
        // Near 2 degrees, one step rotates the cube by 0.03 degrees and changes the gap by 2e-4.
        if (k > -2000) {
          EXPECT_NEAR(contact.least_gap(), before, 3e-4) << degrees;
        }
        before = contact.least_gap();
      }
    }
  }
}

TEST(Manifold, KeepsTheFeaturesOfTheStepBeforeWithinTheMargin) {
  // A corner of one square overlaps a corner of the other along the diagonal, so that two faces have the same depth.
  // Without memory, rounding errors would decide between these faces.
  const Shape<2> square = shape_of<2>({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const PlacedShape<2> one{&square, 1.0, {0, 0}, Mat<2>::Identity()};
  RandomStream random(2, 1);
  AxisFeatures last;
  std::set<std::uint32_t> keys;
  for (int k = 0; k < 100; ++k) {
    const Vec<2> noise(random.uniform(-1e-8, 1e-8), random.uniform(-1e-8, 1e-8));
    const Manifold<2> contact =
        contact_manifold<2>(one, {&square, 1.0, Vec<2>(0.99, 0.99) + noise, Mat<2>::Identity()}, 0.0, &last);
    ASSERT_EQ(contact.n(), 2);
    keys.insert(contact.points[0].key);
  }
  EXPECT_EQ(keys.size(), 1u);
}

/// To save time, the contact remembers the features of the previous step. The remembered features may change the gap by
/// at most the margin.
TEST(Manifold, WithFeaturesOfTheStepBeforeIsThatWithout) {
  RandomStream random(24, 1);
  for (int trial = 0; trial < 200; ++trial) {
    RandomPair<3> pair(random, trial % 2 ? 0.03 : 0.0);
    pair.set_depth(random, 0.001);
    AxisFeatures last;
    auto second = pair.second();
    for (int step = 0; step < 20; ++step) {
      second.position += 1e-3 * random_direction<3>(random);
      second.rotation = (turn_about(random_direction<3>(random), 0.2) * second.rotation).eval();
      const Manifold<3> with = contact_manifold<3>(pair.first(), second, 0.02, &last);
      const Manifold<3> without = contact_manifold<3>(pair.first(), second, 0.02);
      ASSERT_EQ(with.n() > 0, without.n() > 0);
      if (with.n() > 0) {
        EXPECT_NEAR(with.least_gap(), without.least_gap(), 1.1e-4 * 0.5);
      }
    }
  }
}

TEST(Manifold, OfAnyFeaturesOfTheStepBeforeIsSafe) {
  RandomStream random(25, 1);
  for (int trial = 0; trial < 3000; ++trial) {
    RandomPair<3> pair(random, 0.0);
    pair.set_depth(random, 0.01);
    AxisFeatures last{static_cast<AxisKind>(random.below(4)), static_cast<std::int16_t>(random.below(60)),
                      static_cast<std::int16_t>(random.below(60))};
    EXPECT_EQ(contact_manifold<3>(pair.first(), pair.second(), 0.01, &last).n() > 0,
              contact_manifold<3>(pair.first(), pair.second(), 0.01).n() > 0);
  }
}

TEST(Manifold, HasDifferentKeysForItsPoints) {
  RandomStream random(26, 1);
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1));
  for (int trial = 0; trial < 500; ++trial) {
    const auto below = placed<3>(cube, Vec<3>::Zero(), kNoTurn);
    const auto above = placed<3>(cube, {random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), 1.0},
                                 turn_about(Vec<3>::UnitZ(), random.uniform(0.0, 90.0)));
    const Manifold<3> contact = contact_manifold<3>(below, above, 0.01);
    std::set<std::uint32_t> keys;
    for (int k = 0; k < contact.n(); ++k) keys.insert(contact.points[k].key);
    EXPECT_EQ(static_cast<int>(keys.size()), contact.n());
  }
}

TEST(Manifold, OfScaledShapesScales) {
  RandomStream random(27, 1);
  int n_touching = 0;
  for (int trial = 0; trial < 100; ++trial) {
    RandomPair<3> pair(random, 0.02);
    pair.set_depth(random, 0.002);
    auto a = pair.first(), b = pair.second();
    const Manifold<3> one = contact_manifold<3>(a, b, 0.01);
    const Shape<3> half = scaled(*a.shape, 0.5), triple = scaled(*b.shape, 3.0);
    // Changes the unit of length, and uses scales instead of larger shapes.
    a = {&half, 2.0 * a.scale * 10.0, 10.0 * a.position, a.rotation};
    b = {&triple, b.scale * 10.0 / 3.0, 10.0 * b.position, b.rotation};
    const Manifold<3> other = contact_manifold<3>(a, b, 0.1);
    ASSERT_EQ(one.n(), other.n());
    if (one.n() == 0) continue;
    ++n_touching;
    EXPECT_NEAR(10.0 * one.least_gap(), other.least_gap(), 1e-11);
    EXPECT_NEAR((one.normal - other.normal).norm(), 0.0, 1e-11);
  }
  EXPECT_GT(n_touching, 50);
}

}  // namespace
}  // namespace floc
