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

/// Returns the matches of the points `now`, and expects that there are no other matches.
std::vector<int> matched(const Points& now, const Points& before, double radius) {
  const std::vector<int> all = matched_points<3>(std::span(now), std::span(before), radius);
  for (std::size_t k = now.size(); k < all.size(); ++k) EXPECT_EQ(all[k], -1);
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(now.size())};
}

TEST(PointMemory, GoesByKeyHoweverFar) {
  EXPECT_EQ(matched({point(0, 0, 7), point(1, 0, 8)}, {point(0, 0, 8), point(1, 0, 7)}, 0.1),
            (std::vector<int>{1, 0}));
}

TEST(PointMemory, GoesToTheNearestUnclaimedPointInTheRadius) {
  const Points before = {point(0, 0, 1), point(1, 0, 2), point(2, 0, 3)};
  // New point 0 keeps its key. The old point nearest to new point 1 is thus already matched, so new point 1 is matched
  // with the next nearest old point. New point 2 is too far from all old points.
  EXPECT_EQ(matched({point(0.5, 0, 1), point(0.4, 0, 9), point(5, 0, 10)}, before, 0.7),
            (std::vector<int>{0, 1, -1}));
  // Two new points are near one old point. The nearer of the two is matched.
  EXPECT_EQ(matched({point(1.2, 0, 11), point(1.1, 0, 12)}, {before[1]}, 0.7), (std::vector<int>{-1, 0}));
}

TEST(PointMemory, OfNothingIsNothing) {
  EXPECT_EQ(matched({}, {point(0, 0, 1)}, 1.0), std::vector<int>{});
  EXPECT_EQ(matched({point(0, 0, 1)}, {}, 1.0), std::vector<int>{-1});
}

}  // namespace
}  // namespace floc
