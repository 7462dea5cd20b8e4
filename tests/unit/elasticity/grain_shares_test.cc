#include "floc/elasticity/parallel/grain_shares.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace floc {
namespace {

std::vector<Vec<3>> random_places(int n, const Vec<3>& sides) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Vec<3>> places(n);
  for (auto& x : places)
    for (int a = 0; a < 3; ++a) x[a] = sides[a] * uniform(engine);
  return places;
}

TEST(GrainShares, GiveEveryGrainTakenOneBlockAndTheOthersNone) {
  const auto places = random_places(500, {3.0, 2.0, 1.0});
  std::vector<bool> taken(500, true);
  for (int g = 0; g < 500; g += 7) taken[g] = false;
  for (const int n : {1, 2, 3, 4, 7}) {
    const GrainShares shares = share_out<3>(places, taken, n);
    ASSERT_EQ(shares.n_processes(), n);
    EXPECT_EQ(shares.first.front(), 0);
    EXPECT_EQ(shares.first.back(), static_cast<int>(shares.grain.size()));
    for (int g = 0; g < 500; ++g)
      if (taken[g])
        EXPECT_EQ(shares.grain.at(shares.block[g]), g);
      else
        EXPECT_EQ(shares.block[g], -1);
    const double fair = static_cast<double>(shares.grain.size()) / n;
    for (int p = 0; p < n; ++p) EXPECT_NEAR(shares.first[p + 1] - shares.first[p], fair, 2.0) << n;
  }
}

TEST(GrainShares, AreHalvesAcrossTheLongestSide) {
  const auto places = random_places(400, {1.0, 5.0, 1.0});
  const GrainShares shares = share_out<3>(places, std::vector<bool>(400, true), 2);
  double highest = 0.0, lowest = 5.0;
  for (int b = 0; b < shares.first[1]; ++b) highest = std::max(highest, places[shares.grain[b]][1]);
  for (int b = shares.first[1]; b < 400; ++b) lowest = std::min(lowest, places[shares.grain[b]][1]);
  EXPECT_LE(highest, lowest);
}

TEST(GrainShares, OfMoreProcessesThanGrainsLeaveSomeEmpty) {
  const GrainShares shares = share_out<3>(random_places(3, {1, 1, 1}), std::vector<bool>(3, true), 8);
  EXPECT_EQ(shares.first.back(), 3);
  EXPECT_TRUE(std::is_sorted(shares.first.begin(), shares.first.end()));
}

}  // namespace
}  // namespace floc
