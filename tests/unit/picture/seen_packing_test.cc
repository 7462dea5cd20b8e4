#include "floc/picture/seen_packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "floc/picture/hidden_spheres.h"

namespace floc {
namespace {

using Part = SeenPacking::Part;

constexpr double kSeenRounding = 1e-12;

/// View along the z axis from far above, with x to the right and y upwards on the page. The coordinates in this view
/// equal the coordinates in the cell.
View from_above() {
  View view;
  view.azimuth = -90.0;
  view.elevation = 90.0;
  return view;
}

/// Spheres of diameter 1 in a cell of side 4.
PackingPicture<3> spheres_at(const std::vector<Vec<3>>& positions) {
  PackingPicture<3> picture;
  picture.cell.matrix *= 4.0;
  picture.position = positions;
  picture.radius.assign(positions.size(), 0.5);
  return picture;
}

ContactLine<3> line_between(const PackingPicture<3>& picture, int i, int j, const Vec<3>& to) {
  return {picture.position[i], to, LineKind::compression, 1.0, i, j};
}

TEST(SeenPacking, NearerSpheresAreDrawnLater) {
  const auto seen =
      seen_packing(spheres_at({{1, 1, 3}, {1, 1.5, 1}, {3, 3, 2}, {3, 3, 5.5}}), from_above(), {});
  ASSERT_EQ(seen.order.size(), 4u);
  std::vector<int> grains;
  for (const auto& mark : seen.order) grains.push_back(seen.spheres[mark.index].grain);
  // The last sphere is outside the cell; its image at z = 1.5 is drawn.
  EXPECT_EQ(grains, (std::vector<int>{1, 3, 2, 0}));
  EXPECT_NEAR(seen.far, 1.0, kSeenRounding);
  EXPECT_NEAR(seen.near, 3.0, kSeenRounding);
}

TEST(SeenPacking, OrderOfCentresIsRightForTangentSpheresOfAnySize) {
  // If two touching spheres overlap in the picture, the one whose centre is nearer to the eye is in front.
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const double R = 1.0, r = 0.1 + 0.4 * (1.0 + uniform(engine));
    const Vec<3> apart = (R + r) * Vec<3>(uniform(engine), uniform(engine), uniform(engine)).normalized();
    for (int k = 0; k < 50; ++k) {
      const Vec<2> at = apart.head<2>() + r * Vec<2>(uniform(engine), uniform(engine));
      const double to_big = at.squaredNorm(), to_small = (at - apart.head<2>()).squaredNorm();
      if (to_big >= R * R || to_small >= r * r) continue;
      const double front_of_big = std::sqrt(R * R - to_big);
      const double front_of_small = apart[2] + std::sqrt(r * r - to_small);
      EXPECT_EQ(front_of_small > front_of_big, apart[2] > 0.0);
    }
  }
}

TEST(SeenPacking, SpheresBehindOthersAreLeftOut) {
  // A wall of spheres that overlap in the picture, and two more spheres: one is hidden behind the wall, and one
  // is visible beside it.
  std::vector<SeenSphere> spheres;
  for (int x = -6; x <= 6; ++x)
    for (int y = -6; y <= 6; ++y) spheres.push_back({{0.5 * x, 0.5 * y, 1.0 + 1e-3 * x}, 0.5, 0});
  spheres.push_back({{0.2, 0.3, 0.0}, 0.5, 1});
  spheres.push_back({{3.2, 0.3, 0.0}, 0.5, 2});
  std::vector<int> left;
  for (const SeenSphere& s : without_hidden(spheres)) left.push_back(s.grain);
  EXPECT_EQ(std::count(left.begin(), left.end(), 1), 0);
  EXPECT_EQ(std::count(left.begin(), left.end(), 2), 1);
  EXPECT_EQ(std::count(left.begin(), left.end(), 0), 13 * 13);
}

TEST(SeenPacking, TubesReachFromSphereToSphere) {
  PackingPicture<3> picture = spheres_at({{1, 2, 2}, {2, 2, 2}});
  picture.lines = {line_between(picture, 0, 1, {2, 2, 2})};
  View view = from_above();
  view.sphere_size = 0.5;
  DrawnScale scale;
  scale.points_per_force = 0.3;
  const auto seen = seen_packing(picture, view, scale);
  ASSERT_EQ(seen.tubes.size(), 1u);
  const double inside = std::sqrt(0.25 * 0.25 - 0.15 * 0.15);
  EXPECT_TRUE(seen.tubes[0].from.isApprox(Vec<3>(1.0 + inside, 2, 2), kSeenRounding));
  EXPECT_TRUE(seen.tubes[0].to.isApprox(Vec<3>(2.0 - inside, 2, 2), kSeenRounding));
  EXPECT_EQ(seen.tubes[0].from_end, TubeEnd::at_sphere);
  EXPECT_NEAR(seen.tubes[0].width, 0.3, kSeenRounding);
  // If a tube is wider than the spheres, it ends at their centres. If spheres are drawn at full size, they hide all
  // tubes.
  view.sphere_size = 0.2;
  const auto wide = seen_packing(picture, view, scale);
  EXPECT_TRUE(wide.tubes.at(0).from.isApprox(Vec<3>(1, 2, 2), kSeenRounding));
  EXPECT_EQ(wide.tubes.at(0).from_end, TubeEnd::round);
  EXPECT_EQ(wide.tubes.at(0).to_end, TubeEnd::round);
  view.sphere_size = 1.0;
  scale.points_per_force = 0.0;
  EXPECT_TRUE(seen_packing(picture, view, scale).tubes.empty());
}

TEST(SeenPacking, ContactsAcrossAFaceAreCutThere) {
  PackingPicture<3> picture = spheres_at({{3.6, 2, 2}, {0.6, 2, 2}});
  picture.lines = {line_between(picture, 0, 1, {4.6, 2, 2})};
  View view = from_above();
  view.sphere_size = 0.0;
  const auto seen = seen_packing(picture, view, {});
  EXPECT_TRUE(seen.spheres.empty());
  ASSERT_EQ(seen.tubes.size(), 2u);
  EXPECT_TRUE(seen.tubes[0].from.isApprox(Vec<3>(0, 2, 2), kSeenRounding));
  EXPECT_TRUE(seen.tubes[0].to.isApprox(Vec<3>(0.6, 2, 2), kSeenRounding));
  EXPECT_EQ(seen.tubes[0].from_end, TubeEnd::cut);
  EXPECT_EQ(seen.tubes[0].to_end, TubeEnd::round);
  EXPECT_TRUE(seen.tubes[1].from.isApprox(Vec<3>(3.6, 2, 2), kSeenRounding));
  EXPECT_TRUE(seen.tubes[1].to.isApprox(Vec<3>(4, 2, 2), kSeenRounding));
}

TEST(SeenPacking, ContactsWithAWallEndFlatOnIt) {
  PackingPicture<3> picture = spheres_at({{2, 2, 3.5}});
  picture.lines = {line_between(picture, 0, 1, {2, 2, 4})};
  const auto seen = seen_packing(picture, from_above(), {});
  ASSERT_EQ(seen.tubes.size(), 1u);
  EXPECT_TRUE(seen.tubes[0].to.isApprox(Vec<3>(2, 2, 4), kSeenRounding));
  EXPECT_EQ(seen.tubes[0].from_end, TubeEnd::at_sphere);
  EXPECT_EQ(seen.tubes[0].to_end, TubeEnd::cut);
}

TEST(SeenPacking, ASphereHidesWhatIsInItAndBehindIt) {
  const SeenSphere sphere{{0, 0, 0}, 1.0, 0};
  // A line at the depth of the equator, or behind it, is hidden over the full width of the sphere. A line in front of
  // the sphere is not hidden.
  EXPECT_EQ(hidden_part({-2, 0, -3}, {2, 0, -3}, sphere), (std::pair{0.25, 0.75}));
  EXPECT_FALSE(hidden_part({-2, 0, 1.5}, {2, 0, 1.5}, sphere));
  EXPECT_FALSE(hidden_part({-2, 1.5, -3}, {2, 1.5, -3}, sphere));
  // At a depth between the equator and the front of the sphere, a line is hidden over the width of the sphere
  // at this depth.
  const auto part = hidden_part({-2, 0, 0.6}, {2, 0, 0.6}, sphere);
  ASSERT_TRUE(part);
  EXPECT_NEAR(part->first, 0.5 - 0.8 / 4.0, kSeenRounding);
  EXPECT_NEAR(part->second, 0.5 + 0.8 / 4.0, kSeenRounding);
  // A line towards the eye is hidden from its far end to the point where it leaves the sphere.
  const auto towards = hidden_part({0.6, 0, -4}, {0.6, 0, 4}, sphere);
  ASSERT_TRUE(towards);
  EXPECT_EQ(towards->first, 0.0);
  EXPECT_NEAR(towards->second, 0.5 + 0.8 / 8.0, kSeenRounding);
}

TEST(SeenPacking, HiddenPartsAgreeWithRays) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  const SeenSphere sphere{{0.1, -0.2, 0.3}, 1.0, 0};
  for (int trial = 0; trial < 300; ++trial) {
    const Vec<3> from(uniform(engine), uniform(engine), uniform(engine));
    const Vec<3> to(uniform(engine), uniform(engine), uniform(engine));
    const auto part = hidden_part(from, to, sphere);
    for (int k = 0; k <= 20; ++k) {
      const double t = 0.05 * k;
      const Vec<3> apart = from + t * (to - from) - sphere.centre;
      const double beside = apart.head<2>().squaredNorm();
      const bool hidden = beside < 1.0 && apart[2] < std::sqrt(1.0 - beside);
      EXPECT_EQ(hidden, part && t > part->first - kSeenRounding && t < part->second + kSeenRounding)
          << trial << ' ' << t;
    }
  }
}

TEST(SeenPacking, ThreeEdgesOfACellLieBehindAndSixAreItsOutline) {
  const auto count = [](const std::vector<SeenEdge>& edges) {
    return std::pair(std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.behind; }),
                     std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.outline; }));
  };
  Cell<3> cell;
  cell.matrix << 3.0, 0.0, 0.0, 0.4, 2.0, 0.0, -0.3, 0.2, 2.5;
  const auto edges = edges_of(cell, Camera(View()), Vec<3>::Zero(), Vec<3>::Ones());
  EXPECT_EQ(edges.size(), 12u);
  EXPECT_EQ(count(edges), (std::pair<std::ptrdiff_t, std::ptrdiff_t>(3, 6)));
  // In a view along z, the far face and the four edges along the line of sight are behind, although these edges
  // appear only as corners.
  EXPECT_EQ(count(edges_of(Cell<3>(), Camera(from_above()), Vec<3>::Zero(), Vec<3>::Ones())),
            (std::pair<std::ptrdiff_t, std::ptrdiff_t>(8, 4)));
}

TEST(SeenPacking, EdgesBehindASphereAreBroken) {
  // The sphere lies on the upper edge along x that is nearest to the eye. The end x = 0 of this edge is farther from
  // the eye than the sphere. On this side, the outline of the sphere hides more of the edge than the part inside the
  // sphere.
  const double sine = std::cos(20.0 * std::numbers::pi / 180.0) * std::cos(65.0 * std::numbers::pi / 180.0);
  const auto seen = seen_packing(spheres_at({{2, 0, 4.0 - 1e-9}}), View(), {});
  for (const SeenEdge& edge : seen.cell_edges) {
    if (edge.axis != 0 || edge.behind || edge.outline) continue;
    ASSERT_EQ(edge.visible.size(), 2u);
    EXPECT_NEAR(edge.visible[0].second, 0.5 - 0.125 / std::sqrt(1.0 - sine * sine), 1e-6);
    EXPECT_NEAR(edge.visible[1].first, 0.5 + 0.125, 1e-6);
  }
}

TEST(PartInSlab, HoldsCentresAndTheLinesBetweenThem) {
  PackingPicture<3> picture = spheres_at({{1, 1, 0.5}, {1, 1, 1.5}, {1, 1, 2.0}, {1, 1, 6.9}});
  picture.rattler = {false, true, false, true};
  picture.lines = {line_between(picture, 0, 1, {1, 1, 1.5}), line_between(picture, 1, 2, {1, 1, 2.0}),
                   line_between(picture, 2, 3, {1, 1, 2.9}), line_between(picture, 2, 4, {1, 0, 2.0})};
  picture.arrows = {{{1, 1, 0.5}, {0, 0, 1}, 0}, {{1, 1, 2}, {0, 0, 1}, 2}};
  const PackingPicture<3> part = part_in_slab(picture, {2, 0.5, 0.75});
  // The fourth sphere is outside the cell; its image at z = 2.9 is drawn. Body 4 is a wall.
  ASSERT_EQ(part.position.size(), 2u);
  EXPECT_EQ(part.position[0], picture.position[2]);
  EXPECT_EQ(part.position[1], picture.position[3]);
  EXPECT_EQ(part.rattler, (std::vector<bool>{false, true}));
  ASSERT_EQ(part.lines.size(), 2u);
  EXPECT_EQ(std::pair(part.lines[0].i, part.lines[0].j), std::pair(0, 1));
  EXPECT_EQ(std::pair(part.lines[1].i, part.lines[1].j), std::pair(0, 2));
  ASSERT_EQ(part.arrows.size(), 1u);
  EXPECT_EQ(part.arrows[0].grain, 0);
  EXPECT_EQ(part_in_slab(picture, {2, 0.0, 1.0}).position.size(), 4u);
}

}  // namespace
}  // namespace floc
