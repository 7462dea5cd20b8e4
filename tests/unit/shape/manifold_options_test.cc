#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "floc/shape/manifold.h"
#include "unit/shape/pairs.h"
#include "unit/shape/placed.h"
#include "unit/shape/solids.h"

namespace floc {
namespace {

using namespace test;

/// Elastic shapes need a spring at each corner that overlaps. Other corners within the reach, which do not overlap,
/// must not change this.
TEST(Manifold, OfElasticShapesHasAllCornersOfTheOctagon) {
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1));
  const auto below = placed<3>(cube, Vec<3>::Zero(), kNoTurn);
  const Mat<3> tilt = turn_about(Vec<3>::UnitX(), 1e-2) * turn_about(Vec<3>::UnitZ(), 45.0);
  const auto above = placed<3>(cube, {0, 0, 0.99995}, tilt);
  const auto overlapping = [&](double reach) {
    const Manifold<3> contact = contact_manifold<3>(below, above, reach);
    std::set<std::uint32_t> keys;
    for (int k = 0; k < contact.n(); ++k)
      if (contact.points[k].gap < 0.0) keys.insert(contact.points[k].key);
    return keys;
  };
  EXPECT_EQ(contact_manifold<3>(below, above, 0.01).n(), 8);
  EXPECT_EQ(overlapping(0.01), overlapping(0.0));
  EXPECT_GE(overlapping(0.0).size(), 4u);
}

/// The lowest edge of a chisel lies on a face. A facet at one end of the edge makes a smaller angle with the face than
/// the two sides of the chisel, but has only one vertex on the face.
TEST(Manifold, OfExactShapesHasBothEndsOfAnEdgeOnAFace) {
  const double rise = 3.0 * std::tan(10.0 / 180.0 * std::numbers::pi);
  const Shape<3> chisel = shape_of<3>({{-1, 0, 0},
                                       {1, 0, 0},
                                       {-1, 0.5, 1},
                                       {-1, -0.5, 1},
                                       {4, 0.5, 1},
                                       {4, -0.5, 1},
                                       {4, 0.5 * rise, rise},
                                       {4, -0.5 * rise, rise}});
  const Shape<3> cube = shape_of<3>(box_points(20, 20, 1));
  const auto below = placed<3>(cube, Vec<3>::Zero(), kNoTurn);
  const auto above = placed<3>(chisel, {0, 0, 0.5 + 1e-9}, kNoTurn);
  const Manifold<3> exact = contact_manifold<3>(below, above, 1e-3, nullptr, {.exact = true});
  EXPECT_EQ(exact.n(), 2);
  EXPECT_EQ(exact.type, ContactType::kDouble);
}

/// Two edges cross, and a face is almost as near as the crossing.
TEST(Manifold, OfExactShapesHasTheNormalOfCrossedEdges) {
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1));
  const auto below = placed<3>(cube, Vec<3>::Zero(), kNoTurn);
  // The upper cube stands on an edge, which is tilted by 2e-6 and crosses an edge of the lower cube.
  const Mat<3> tilt =
      turn_about(Vec<3>::UnitX(), -2e-6 * 180.0 / std::numbers::pi) * turn_about(Vec<3>::UnitY(), 45.0);
  const auto above = placed<3>(cube, {0, 0.9, 0.5 + std::numbers::sqrt2 / 2.0}, tilt);
  const Manifold<3> exact = contact_manifold<3>(below, above, 1e-3, nullptr, {.exact = true});
  EXPECT_EQ(exact.type, ContactType::kEdgeEdge);
  EXPECT_NEAR(std::abs(exact.normal[1]), 2e-6, 1e-8);
}

/// An edge that lies on a face and extends beyond it has two contact points, whether the edge overlaps the face a little
/// or is a little above it. The point at which the edge crosses the boundary of the face is also a crossing of two edges.
TEST(Manifold, OfAnEdgeOnAFaceHasTwoPointsAtSmallGapsAndOverlaps) {
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1));
  const auto below = placed<3>(cube, Vec<3>::Zero(), kNoTurn);
  for (const double tilt : {1e-5, 3e-5, 1e-4}) {
    for (const double gap : {-1e-5, -1e-7, -1e-9, 1e-9, 1e-7, 1e-5}) {
      // The upper cube stands on an edge along y, and the lower end of this edge is beyond the face.
      const Mat<3> turn =
          turn_about(Vec<3>::UnitX(), -tilt * 180.0 / std::numbers::pi) * turn_about(Vec<3>::UnitY(), 45.0);
      const double height = 0.5 + std::numbers::sqrt2 / 2.0 * std::cos(tilt);
      const auto above = placed<3>(cube, {0, 0.2, height + 0.3 * tilt + gap}, turn);
      const Manifold<3> contact = contact_manifold<3>(below, above, 1e-2, nullptr, {.face_preference = 0.5});
      EXPECT_EQ(contact.type, ContactType::kDouble) << tilt << ' ' << gap;
      EXPECT_NEAR(contact.least_gap(), gap, 1e-8) << tilt << ' ' << gap;
    }
  }
}

/// A recorded contact point is found again at any larger reach.
TEST(Manifold, OfALargerReachHasTheSamePoints) {
  const Shape<3> cube = shape_of<3>(box_points(1, 1, 1));
  const auto below = placed<3>(cube, Vec<3>::Zero(), kNoTurn);
  RandomStream random(31, 1);
  for (int trial = 0; trial < 50; ++trial) {
    // The two faces have a polygon with up to eight corners in common. Some of these corners are within the first
    // reach.
    const Mat<3> tilt =
        turn_about(random_direction<3>(random), 0.02) * turn_about(Vec<3>::UnitZ(), 30.0 + 0.6 * trial);
    const auto above = placed<3>(cube, {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.99985}, tilt);
    const auto found_within = [&](double reach) {
      return contact_manifold<3>(below, above, reach, nullptr, {.face_preference = 0.5});
    };
    const Manifold<3> near = found_within(0.0);
    for (const ManifoldPoint<3>& point : near.points) {
      for (const double reach : {1e-4, 1e-2, 1.0}) {
        const Manifold<3> found = found_within(reach);
        const ManifoldPoint<3>* again = found.with_key(point.key);
        ASSERT_NE(again, nullptr) << trial << ' ' << reach;
        EXPECT_EQ(again->gap, point.gap);
        EXPECT_EQ(again->arm, point.arm);
      }
    }
  }
}

/// If faces are preferred, an edge pair defines a contact only in two cases: its overlap is much smaller than that of
/// the faces, or no point above the face is as deep as the edge pair. No overlap must be lost.
TEST(Manifold, OfOverlappingPolyhedraPrefersFaces) {
  RandomStream random(29, 1);
  const double share = 0.5;
  int n_edges = 0, n_faces_instead = 0;
  for (int trial = 0; trial < 400; ++trial) {
    RandomPair<3> pair(random, 0.0);
    const double overlap = std::pow(10.0, random.uniform(-3.0, -1.0));  // along the normals of faces
    pair.set_depth(random, overlap);
    const Manifold<3> deepest = contact_manifold<3>(pair.first(), pair.second(), 1.0);
    if (deepest.type != ContactType::kEdgeEdge || deepest.least_gap() > 0.0) continue;
    const Manifold<3> contact =
        contact_manifold<3>(pair.first(), pair.second(), 1.0, nullptr, {.face_preference = share});
    const bool is_edge_pair = contact.type == ContactType::kEdgeEdge;
    const double margin = 1e-4 * std::min(pair.first().inner_radius(), pair.second().inner_radius());
    const bool is_much_smaller = -deepest.least_gap() < (1.0 - share) * overlap - margin;
    EXPECT_TRUE(is_edge_pair || !is_much_smaller) << trial;
    EXPECT_TRUE(!is_edge_pair || contact.least_gap() == deepest.least_gap()) << trial;
    EXPECT_GE(contact.least_gap(), -overlap - 1e-12) << trial;
    EXPECT_LE(contact.least_gap(), deepest.least_gap()) << trial;
    ++(is_edge_pair ? n_edges : n_faces_instead);
  }
  EXPECT_GT(n_edges, 10);
  EXPECT_GT(n_faces_instead, 10);
}

}  // namespace
}  // namespace floc
