#include "floc/fitting/collapse_jumps.h"

#include <gtest/gtest.h>

#include "floc/fitting/supported_law.h"
#include "support/coverage.h"
#include "support/synthetic_ensemble.h"

namespace floc::test {
namespace {

TEST(CollapseJumps, HaveTheDistanceWithWhichTheyWereMade) {
  for (const double gap : {0.15, 0.3, 0.5, 1.0}) {
    Staircases staircases;
    staircases.gap = gap;
    RandomStream random(3, 0);
    const ConsolidationCurve mean = staircases.mean_of(200, random);
    const LawPoints points = law_points(mean, Weighting::uniform);
    constexpr int kFirst = 14;  // index of the first point after the first jumps of all samples
    const Eigen::Index n = points.size() - kFirst;
    EXPECT_NEAR(distance_of_jumps(mean.samples.bottomRows(n), points.log_P.tail(n), staircases.lambda) / gap,
                1.0, 0.15)
        << gap;
  }
}

TEST(CollapseJumps, LeaveOutTheLagButNotTheCurve) {
  const Eigen::VectorXd log_P = Eigen::VectorXd::LinSpaced(21, 0.0, 5.0);
  EXPECT_EQ(points_in_lag(log_P, 0.0), 0);
  EXPECT_EQ(points_in_lag(log_P, 0.5), 4);
  EXPECT_EQ(points_in_lag(log_P, 100.0), 11);
  EXPECT_EQ(points_in_lag(log_P.head(5), 100.0), 0);
}

TEST(CollapseJumps, DoNotMakeABendThatTheSamplesDoNotShow) {
  Staircases staircases;
  staircases.gap = 0.3;
  RandomStream random(3, 0);
  int straight = 0, bent = 0;
  constexpr int kEnsembles = 100;
  for (int k = 0; k < kEnsembles; ++k) {
    const ConsolidationCurve mean = staircases.mean_of(8, random);
    const LawPoints points = law_points(mean, Weighting::uniform);
    straight += samples_bend_at(mean.samples.bottomRows(13), points.log_P.tail(13), 7);
    // From the middle on, the values of all samples stay constant.
    Eigen::MatrixXd stopped = mean.samples.bottomRows(13);
    for (Eigen::Index row = 7; row < 13; ++row) stopped.row(row) = stopped.row(6);
    bent += samples_bend_at(stopped, points.log_P.tail(13), 7);
  }
  EXPECT_LE(straight, 3);
  EXPECT_GE(bent, 80);
}

TEST(CollapseJumps, LeaveIntervalsOfLambdaThatHoldTheTruth) {
  constexpr int kEnsembles = 200;
  for (const double gap : {0.3, 1.0}) {
    Staircases staircases;
    staircases.gap = gap;
    RandomStream random(3, 0);
    Coverage coverage({{"lambda", staircases.lambda}});
    for (int k = 0; k < kEnsembles; ++k)
      for (const FittedParameter& p : fit_supported_law(staircases.mean_of(6, random), {}).parameters)
        coverage.add(p);
    coverage.expect_honest(kEnsembles, "gap " + std::to_string(gap));
  }
}

}  // namespace
}  // namespace floc::test
