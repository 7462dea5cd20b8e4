#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "support/published_consolidation.h"

namespace floc::test {
namespace {

/// Sums over repeated fits for one parameter: sums of errors, and number of intervals that contain the true value.
struct Tally {
  double truth;
  int n = 0, covered = 0;
  double sum_of_misses = 0, sum_of_errors = 0;

  void add(const FittedParameter& p) {
    ++n;
    covered += p.low95 && p.high95 && *p.low95 <= truth && truth <= *p.high95;
    sum_of_misses += *p.value - truth;
    sum_of_errors += *p.standard_error;
  }
};

/// Fits 500 noisy copies of a curve. Expects that the bias is below a third of the stated error, and that the 95 %
/// intervals contain the true value in 92 to 97 % of the fits.
void expect_honest_errors(const ConsolidationCurve& exact, const ConsolidationOptions& options,
                          std::map<std::string, Tally> tallies) {
  constexpr int kRepeats = 500;
  constexpr double kNoise = 0.003;
  RandomStream random(11, 0);
  for (int k = 0; k < kRepeats; ++k) {
    const auto fit = fit_consolidation(with_relative_noise(exact, kNoise, random), options);
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    for (auto& [name, tally] : tallies) {
      const FittedParameter* p = fit.find(name);
      ASSERT_TRUE(p && p->value) << name << " in repetition " << k;
      tally.add(*p);
    }
  }
  for (const auto& [name, tally] : tallies) {
    const double share = tally.covered / static_cast<double>(tally.n);
    EXPECT_LT(std::abs(tally.sum_of_misses), tally.sum_of_errors / 3) << name;
    EXPECT_GE(share, 0.92) << name;
    EXPECT_LE(share, 0.97) << name;
    std::printf("%-8s bias/error %6.3f, coverage %.3f\n", name.c_str(),
                tally.sum_of_misses / tally.sum_of_errors, share);
  }
}

std::map<std::string, Tally> truth_of(const Published& set) {
  const auto law = set.law();
  return {
      {"lambda", {law.lambda}}, {"alpha", {law.alpha}}, {"Phi_max", {law.phi_max}}, {"P1_star", {law.P1_star}}};
}

TEST(ConsolidationCoverage, PublishedProtocolFromP0On) {
  for (const Published& set : {kNoRolling, kSmallRolling}) {
    const auto exact = curve_of(set.law(), published_pressures(set.P0_star));
    ConsolidationOptions options;
    options.hold_P0 = true;
    options.window = {exact.P_star.front(), exact.P_star.back()};
    auto truth = truth_of(set);
    truth["Phi0"] = {exact.phi.front()};
    expect_honest_errors(exact, options, truth);
  }
}

TEST(ConsolidationCoverage, AutomaticFromP0On) {
  for (const Published& set : {kNoRolling, kSmallRolling})
    expect_honest_errors(curve_of(set.law(), published_pressures(set.P0_star)), {}, truth_of(set));
}

TEST(ConsolidationCoverage, AutomaticWithThePlateauToBeFound) {
  for (const Published& set : {kNoRolling, kSmallRolling}) {
    auto truth = truth_of(set);
    truth["Phi0"] = {set.phi0};
    expect_honest_errors(set.with_plateau(), {}, truth);
  }
}

}  // namespace
}  // namespace floc::test
