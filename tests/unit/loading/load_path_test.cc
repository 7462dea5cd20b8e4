#include "floc/loading/load_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floc {
namespace {

LoadTurn turn_to(double to) {
  LoadTurn turn;
  turn.to = to;
  return turn;
}

TEST(TurnPressures, PublishedPathHasTwentyFiveStepsOfAnEighthOfADecade) {
  LoadTurn turn = turn_to(13.33);
  turn.steps_per_decade = 8;
  const auto p = turn_pressures(0.01, turn);
  ASSERT_EQ(p.size(), 25u);
  for (int k = 0; k < 24; ++k) EXPECT_NEAR(p[k], 0.01 * std::pow(10.0, (k + 1) / 8.0), 1e-15 * p[k] * 8);
  EXPECT_EQ(p.back(), 13.33);
}

TEST(TurnPressures, UnloadingGoesDownByTheSameFactorAndEndsExactly) {
  LoadTurn turn = turn_to(0.01);
  turn.steps_per_decade = 4;
  const auto p = turn_pressures(13.33, turn);
  ASSERT_EQ(p.size(), 13u);
  // pow() and two roundings: a few units in the last place.
  for (std::size_t k = 1; k + 1 < p.size(); ++k) EXPECT_NEAR(p[k - 1] / p[k], std::pow(10.0, 0.25), 1e-14);
  EXPECT_LT(p[p.size() - 2] / p.back(), std::pow(10.0, 0.25));
  EXPECT_EQ(p.back(), 0.01);
}

TEST(TurnPressures, AWholeNumberOfStepsIsNotFollowedByAnEmptyOne) {
  LoadTurn turn = turn_to(1.0);
  turn.steps_per_decade = 10;
  EXPECT_EQ(turn_pressures(0.001, turn).size(), 30u);
}

TEST(TurnPressures, AGivenNumberOfStepsHasEqualFactors) {
  LoadTurn turn = turn_to(8.0);
  turn.steps = 3;
  const auto p = turn_pressures(1.0, turn);
  ASSERT_EQ(p.size(), 3u);
  EXPECT_NEAR(p[0], 2.0, 1e-14);
  EXPECT_NEAR(p[1], 4.0, 1e-14);
  EXPECT_EQ(p[2], 8.0);
}

TEST(TurnPressures, AHoldAndTurnsFromOrToZeroAreOneStep) {
  LoadTurn turn = turn_to(0.5);
  turn.steps_per_decade = 8;
  EXPECT_EQ(turn_pressures(0.5, turn), std::vector<double>{0.5});
  EXPECT_EQ(turn_pressures(0.0, turn), std::vector<double>{0.5});
  EXPECT_EQ(turn_pressures(0.5, turn_to(0.0)), std::vector<double>{0.0});
}

}  // namespace
}  // namespace floc
