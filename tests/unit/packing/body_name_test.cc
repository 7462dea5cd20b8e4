#include "floc/packing/body_name.h"

#include <gtest/gtest.h>

#include <set>

namespace floc {
namespace {

/// Returns three grains between two walls, with the given identifiers.
Packing<2> boxed(std::vector<std::int64_t> ids) {
  Packing<2> packing;
  packing.grains.position.assign(3, Vec<2>::Zero());
  packing.grains.radius.assign(3, 0.5);
  packing.grains.id = std::move(ids);
  for (const int side : {-1, 1}) {
    Wall<2> wall;
    wall.axis = 1;
    wall.side = side;
    packing.walls.push_back(wall);
  }
  return packing;
}

TEST(BodyNumbers, OfWallsFollowThoseOfTheGrains) {
  const Packing<2> packing = boxed({});
  const BodyNumbers<2> numbers(packing);
  for (int body = 0; body < 5; ++body) EXPECT_EQ(numbers.of(body), body);
}

TEST(BodyNumbers, AreDifferentForAllBodiesWhateverTheIdentifiersAre) {
  for (const std::vector<std::int64_t>& ids :
       {std::vector<std::int64_t>{1, 2, 3}, {4, 3, 2}, {3, 4, 6}, {-5, 0, 1}, {7, 1'000'000'000'000, 0}}) {
    const Packing<2> packing = boxed(ids);
    const BodyNumbers<2> numbers(packing);
    std::set<std::int64_t> all;
    for (int body = 0; body < 5; ++body) all.insert(numbers.of(body));
    EXPECT_EQ(all.size(), 5u);
    for (int grain = 0; grain < 3; ++grain) EXPECT_EQ(numbers.of(grain), ids[grain]);
  }
}

}  // namespace
}  // namespace floc
