#include "floc/tradeoff/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "floc/tradeoff/tradeoff.h"

namespace floc {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A state of which only what the comparison reads is made.
ObservedState state(int stage, double pressure, double phi, double B) {
  ObservedState s;
  s.stage = stage;
  s.mean_stress = s.driven_load = s.driven_stress = pressure;
  s.observation.fill(kNoNumber);
  s.observation[kPhi] = phi;
  s.observation[kB] = B;
  s.settled = s.observation;
  return s;
}

/// Assembled, then three steps of which the second collapses.
SamplePath path(double shift) {
  SamplePath p;
  p.states = {state(-1, 0.01, 0.5, 1000.0), state(0, 0.02, 0.50001 + shift, 1000.0),
              state(0, 0.04, 0.6 + shift, 2000.0), state(0, 0.08, 0.60001 + shift, 2000.0)};
  return p;
}

TEST(Comparison, QuantileOfErrorsAndItsConfidenceLimitAreOrderStatistics) {
  std::vector<double> errors(100);
  std::iota(errors.begin(), errors.end(), 1.0);
  const Spread spread = spread_of(errors);
  EXPECT_EQ(spread.n, 100);
  EXPECT_EQ(spread.error, 95.0);
  // The binomial distribution of 100 with 0.95: at most 97 with probability 0.882, at most 98 with 0.963.
  EXPECT_EQ(spread.high, 99.0);
}

TEST(Comparison, WithFewErrorsTheLimitIsTheLargest) {
  const Spread spread = spread_of({0.3, kNoNumber, 0.1, 0.2});
  EXPECT_EQ(spread.n, 3);
  EXPECT_EQ(spread.error, 0.3);
  EXPECT_EQ(spread.high, 0.3);
  EXPECT_EQ(spread_of({}).n, 0);
}

TEST(Comparison, MeanOfPairsHasTheirStandardError) {
  const MeanDifference mean = mean_of({1.0, kNoNumber, 3.0, 5.0});
  EXPECT_EQ(mean.n, 3);
  EXPECT_EQ(mean.difference, 3.0);
  EXPECT_DOUBLE_EQ(mean.standard_error, 2.0 / std::sqrt(3.0));
  EXPECT_NEAR(mean.error95 / mean.standard_error, 4.302653, 1e-6);  // Student's t of two degrees of freedom
}

TEST(Comparison, StatesAreComparedUntilTheFirstCollapseOfEither) {
  EXPECT_EQ(before_collapse(path(0.0), path(0.0)), (std::vector<bool>{false, true, false, false}));
  SamplePath early = path(0.0);
  early.states[1].observation[kPhi] = 0.55;
  EXPECT_EQ(before_collapse(path(0.0), early), (std::vector<bool>{false, false, false, false}));
}

TEST(Comparison, ANewTurnStartsFromTheReferenceAgain) {
  SamplePath reference = path(0.0), other = path(0.01);
  reference.states.push_back(state(1, 0.04, 0.6, 2000.0));
  other.states.push_back(state(1, 0.04, 0.6, 2000.0));  // 0.01 away from the other's own last state
  EXPECT_TRUE(before_collapse(reference, other).back());
}

TEST(Comparison, ErrorsAreAgainstTheReferenceBeforeACollapseAndTheSettledStateAfter) {
  const SamplePath reference = path(0.0);
  SamplePath other = path(0.0);
  other.states[1].observation[kPhi] *= 1.0 + 1e-6;                          // moved from the reference
  other.states[3].observation[kPhi] *= 1.0 + 1e-3;                          // not settled
  other.states[2].observation[kPhi] = other.states[2].settled[kPhi] = 0.7;  // another collapse, but settled
  const ObservableError e = compare({&reference}, {&other}, std::nullopt)[kPhi];
  EXPECT_EQ(e.before.n, 1);
  EXPECT_NEAR(e.before.high, 1e-6, 1e-12);
  EXPECT_EQ(e.after.n, 3);
  EXPECT_NEAR(e.after.high, 1e-3, 1e-6);
  // Means over the assembled and the collapsed states: 0.1/0.65 and 1e-3 of three.
  EXPECT_NEAR(e.mean.difference, (0.1 / 0.65 + 1e-3) / 3.0, 1e-6);
}

TEST(Comparison, SamplingErrorFallsWithTheRootOfTheirNumber) {
  const SamplePath a = path(0.0), b = path(0.02);
  const double one = sampling_errors({&a, &b}, 1, std::nullopt)[kPhi].mean.standard_error;
  EXPECT_GT(one, 0.0);
  EXPECT_DOUBLE_EQ(sampling_errors({&a, &b}, 4, std::nullopt)[kPhi].mean.standard_error, 0.5 * one);
}

TEST(Tradeoff, FrontHoldsWhatNoOtherBeatsInBothCostAndError) {
  Tradeoff t;
  for (const auto& [cost, error] :
       {std::pair(1.0, 0.1), std::pair(2.0, 0.2), std::pair(3.0, 0.01), std::pair(3.0, 0.02)}) {
    MeasuredSetting m;
    m.core_seconds = cost;
    m.errors[kB].before = {error, error, 10};
    t.settings.push_back(m);
  }
  EXPECT_EQ(pareto_front(t, kB), (std::vector<bool>{true, false, true, false}));
  EXPECT_EQ(pareto_front(t, kPhi), (std::vector<bool>{false, false, false, false}));  // nothing compared
}

}  // namespace
}  // namespace floc
