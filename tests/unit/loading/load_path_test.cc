#include "floc/loading/load_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floc {
namespace {

LoadStage stage_to(double to) {
  LoadStage stage;
  stage.to = to;
  return stage;
}

TEST(StagePressures, PublishedPathHasTwentyFiveStepsOfAnEighthOfADecade) {
  LoadStage stage = stage_to(13.33);
  stage.steps_per_decade = 8;
  const auto p = stage_pressures(0.01, stage);
  ASSERT_EQ(p.size(), 25u);
  for (int k = 0; k < 24; ++k) EXPECT_NEAR(p[k], 0.01 * std::pow(10.0, (k + 1) / 8.0), 1e-15 * p[k] * 8);
  EXPECT_EQ(p.back(), 13.33);
}

TEST(StagePressures, UnloadingGoesDownByTheSameFactorAndEndsExactly) {
  LoadStage stage = stage_to(0.01);
  stage.steps_per_decade = 4;
  const auto p = stage_pressures(13.33, stage);
  ASSERT_EQ(p.size(), 13u);
  // pow() and two more operations have rounding errors of a few units in the last place.
  for (std::size_t k = 1; k + 1 < p.size(); ++k) EXPECT_NEAR(p[k - 1] / p[k], std::pow(10.0, 0.25), 1e-14);
  EXPECT_LT(p[p.size() - 2] / p.back(), std::pow(10.0, 0.25));
  EXPECT_EQ(p.back(), 0.01);
}

TEST(StagePressures, AWholeNumberOfStepsIsNotFollowedByAnEmptyOne) {
  LoadStage stage = stage_to(1.0);
  stage.steps_per_decade = 10;
  EXPECT_EQ(stage_pressures(0.001, stage).size(), 30u);
}

TEST(StagePressures, AGivenNumberOfStepsHasEqualFactors) {
  LoadStage stage = stage_to(8.0);
  stage.steps = 3;
  const auto p = stage_pressures(1.0, stage);
  ASSERT_EQ(p.size(), 3u);
  EXPECT_NEAR(p[0], 2.0, 1e-14);
  EXPECT_NEAR(p[1], 4.0, 1e-14);
  EXPECT_EQ(p[2], 8.0);
}

TEST(StagePressures, AHoldAndStagesFromOrToZeroAreOneStep) {
  LoadStage stage = stage_to(0.5);
  stage.steps_per_decade = 8;
  EXPECT_EQ(stage_pressures(0.5, stage), std::vector<double>{0.5});
  EXPECT_EQ(stage_pressures(0.0, stage), std::vector<double>{0.5});
  EXPECT_EQ(stage_pressures(0.5, stage_to(0.0)), std::vector<double>{0.0});
}

}  // namespace
}  // namespace floc
