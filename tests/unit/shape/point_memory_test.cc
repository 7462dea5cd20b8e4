#include "floc/shape/point_memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace floc {
namespace {

ManifoldPoint<3> point(double x, double y, std::uint32_t key) {
  ManifoldPoint<3> p;
  p.arm = {x, y, 0};
  p.key = key;
  return p;
}

using Points = std::vector<ManifoldPoint<3>>;

PointMatches<3> matched(const Points& now, const Points& before, double radius) {
  return matched_points<3>(std::span(now), std::span(before), radius);
}

TEST(PointMemory, GoesByKeyHoweverFar) {
  EXPECT_EQ(matched({point(0, 0, 7), point(1, 0, 8)}, {point(0, 0, 8), point(1, 0, 7)}, 0.1),
            (PointMatches<3>{1, 0, -1, -1}));
}

TEST(PointMemory, GoesToTheNearestUnclaimedPointInTheRadius) {
  const Points before = {point(0, 0, 1), point(1, 0, 2), point(2, 0, 3)};
  // Point 0 keeps its key. The old point that is nearest to point 1 belongs to point 0, so point 1 is matched with the
  // next nearest old point. Point 2 is too far from all old points.
  EXPECT_EQ(matched({point(0.5, 0, 1), point(0.4, 0, 9), point(5, 0, 10)}, before, 0.7),
            (PointMatches<3>{0, 1, -1, -1}));
  // Two new points are near one old point. The nearer one of the new points is matched.
  EXPECT_EQ(matched({point(1.2, 0, 11), point(1.1, 0, 12)}, {before[1]}, 0.7),
            (PointMatches<3>{-1, 0, -1, -1}));
}

TEST(PointMemory, OfNothingIsNothing) {
  EXPECT_EQ(matched({}, {point(0, 0, 1)}, 1.0), (PointMatches<3>{-1, -1, -1, -1}));
  EXPECT_EQ(matched({point(0, 0, 1)}, {}, 1.0), (PointMatches<3>{-1, -1, -1, -1}));
}

}  // namespace
}  // namespace floc
