#include "floc/tradeoff/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "floc/tradeoff/path_fits.h"
#include "floc/tradeoff/tradeoff.h"

namespace floc {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Returns a state with only the numbers that the comparison needs.
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

/// Returns a path with the assembled state and three loading steps. The second loading step is a collapse.
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
  // The number of errors (out of 100) below the 95 % quantile has a binomial distribution. It is at most 97 with
  // probability 0.882, and at most 98 with probability 0.963.
  EXPECT_EQ(spread.high, 99.0);
}

TEST(Comparison, LimitOfFewErrorsIsAMultipleOfTheLargest) {
  const Spread spread = spread_of({0.3, kNoNumber, 0.1, 0.2});
  EXPECT_EQ(spread.n, 3);
  EXPECT_EQ(spread.error, 0.3);
  // Three normal errors are all below 0.479 standard deviations in magnitude with the probability 0.3684^3 = 0.05;
  // 1.960/0.479 = 4.09.
  EXPECT_NEAR(spread.high, 0.3 * 4.09, 0.3 * 0.01);
  EXPECT_EQ(spread_of({}).n, 0);
}

TEST(Comparison, LimitsOfNormalErrorsHaveTheirConfidence) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 4000;
  for (const int n : {1, 2, 5, 8, 20, 40, 58, 59, 80}) {
    int above = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      std::vector<double> errors(n);
      for (double& e : errors) e = std::abs(normal(generator));
      above += spread_of(errors).high >= 1.959964;
    }
    // For most n, an order statistic is a limit with a probability that is larger than 95 %. Three standard errors of
    // the measured fraction are 0.0103.
    EXPECT_GE(above, (0.95 - 0.0103) * kDraws) << n;
    const double most = n < 59 ? 0.95 + 0.0103 : 1.0;
    EXPECT_LE(above, most * kDraws) << n;
  }
}

TEST(Comparison, MeanOfPairsHasTheirStandardError) {
  const MeanDifference mean = mean_of({1.0, kNoNumber, 3.0, 5.0});
  EXPECT_EQ(mean.n, 3);
  EXPECT_EQ(mean.difference, 3.0);
  EXPECT_DOUBLE_EQ(mean.standard_error, 2.0 / std::sqrt(3.0));
  EXPECT_NEAR(mean.error95 / mean.standard_error, 4.302653, 1e-6);  // Student's t with two degrees of freedom
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
  // on this path, the new state has a Phi that is 0.01 lower than at the previous state
  other.states.push_back(state(1, 0.04, 0.6, 2000.0));
  EXPECT_TRUE(before_collapse(reference, other).back());
}

TEST(Comparison, ErrorsAreAgainstTheReferenceBeforeACollapseAndTheSettledStateAfter) {
  const SamplePath reference = path(0.0);
  SamplePath other = path(0.0);
  other.states[1].observation[kPhi] *= 1.0 + 1e-6;                          // differs from the reference
  other.states[3].observation[kPhi] *= 1.0 + 1e-3;                          // not settled
  other.states[2].observation[kPhi] = other.states[2].settled[kPhi] = 0.7;  // another collapse, but settled
  const ObservableError e = compare({&reference}, {&other}, std::nullopt)[kPhi];
  EXPECT_EQ(e.before.n, 1);
  EXPECT_NEAR(e.before.error, 1e-6, 1e-12);
  EXPECT_EQ(e.after.n, 3);
  EXPECT_NEAR(e.after.error, 1e-3, 1e-6);
  // Mean over three states: the assembled state, the state at the collapse and the state after it. Their
  // differences are 0, 0.1/0.65 and 1e-3.
  EXPECT_NEAR(e.mean.difference, (0.1 / 0.65 + 1e-3) / 3.0, 1e-6);
}

/// Paths with different steps are compared only at the loads that occur in both paths.
TEST(Comparison, MeansOfOtherStepsAreOverEqualLoads) {
  const SamplePath reference = path(0.0);
  SamplePath coarse;
  coarse.states = {state(-1, 0.01, 0.5, 1000.0), state(0, 0.04 * (1.0 + 1e-12), 0.63, 2000.0),
                   state(0, 0.08, 0.60001, 2000.0)};
  const MeanDifference mean = compare_means({&reference}, {&coarse}, std::nullopt)[kPhi].mean;
  EXPECT_EQ(mean.n, 1);
  EXPECT_NEAR(mean.difference, (0.03 / 0.615) / 3.0,
              1e-12);  // of three pairs of states, only the second differs
  SamplePath fine = reference;
  fine.states.insert(fine.states.begin() + 2, state(0, 0.03, 0.9, 1.0));
  EXPECT_EQ(compare_means({&reference}, {&fine}, std::nullopt)[kPhi].mean.difference, 0.0);
}

/// A shear test with known values of the peak ratio and of the mean ratio over the last quarter of the test.
TEST(Comparison, ShearTestsHaveTheirPeakAndTheirCriticalState) {
  SamplePath test;
  const std::vector<double> ratios = {0.1, 0.3, 0.5, 0.45, 0.4, 0.4, 0.38, 0.36, 0.34, 0.33, 0.32, 0.31};
  for (const double ratio : ratios) {
    ObservedState s = state(0, 1.0, 0.8, 1.0);
    s.control = "triaxial";
    s.observation[kStressRatio] = ratio;
    test.states.push_back(s);
  }
  EXPECT_EQ(path_value(kPeakRatio, test), 0.5);
  EXPECT_NEAR(path_value(kCriticalRatio, test), 0.32, 1e-12);
  EXPECT_TRUE(std::isnan(path_value(kK0, test)));
  test.states.resize(8);  // its last quarter has only two states
  EXPECT_TRUE(std::isnan(path_value(kCriticalRatio, test)));
}

TEST(Comparison, SamplingErrorFallsWithTheRootOfTheirNumber) {
  const SamplePath a = path(0.0), b = path(0.02);
  const double one = sampling_errors({&a, &b}, 1, std::nullopt)[kPhi].mean.standard_error;
  // The relative standard deviation of two samples a and b is sqrt(2) times the mean of 0.02/(Phi_a + Phi_b) over all
  // states.
  EXPECT_NEAR(one, std::sqrt(2.0) * 0.25 * (0.02 / 1.02002 + 0.02 / 1.22 + 0.02 / 1.22002), 1e-9);
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
  EXPECT_EQ(pareto_front(t, kPhi), (std::vector<bool>{false, false, false, false}));  // no values were compared
}

}  // namespace
}  // namespace floc
