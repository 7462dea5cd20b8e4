#include "floc/fitting/elastic_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floc/base/random.h"

namespace floc {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Elastic, RecoversTheModulusOfAStraightBranch) {
  std::vector<double> P, phi;
  for (const double p : {13.3, 7.5, 4.2, 1.3, 0.1}) {
    P.push_back(p);
    phi.push_back(0.77 * std::exp(p / 2.6e4));
  }
  const auto fit = fit_elastic(P, phi);
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  // Phi changes by only 5e-4 along the branch. Relative to this change, the rounding errors of Phi (1e-16) are 2e-13.
  EXPECT_NEAR(*fit.parameters[0].value, 2.6e4, 1e-10 * 2.6e4);
  EXPECT_NEAR(*fit.parameters[1].value, 0.77, 1e-14);
  EXPECT_TRUE(fit.warnings.empty());
}

TEST(Elastic, IntervalsCoverTheTruthAndCurvatureIsSaid) {
  constexpr int kRepeats = 200;
  RandomStream random(3, 0);
  int covered = 0;
  for (int k = 0; k < kRepeats; ++k) {
    std::vector<double> P, phi;
    for (int i = 0; i < 8; ++i) {
      P.push_back(8.0 - i);
      phi.push_back(0.7 * std::exp(P.back() / 500 + 2e-4 * random.normal()));
    }
    const FittedParameter B = fit_elastic(P, phi).parameters[0];
    covered += *B.low95 <= 500 && 500 <= *B.high95;
  }
  // If each interval contains the true value with probability 0.95, between 180 and 198 of 200 intervals contain it,
  // with probability 0.995.
  EXPECT_GE(covered, 180);
  EXPECT_LE(covered, 198);

  std::vector<double> P, phi;
  for (int i = 0; i < 6; ++i) {
    P.push_back(10.0 + i);
    phi.push_back(0.7 * std::exp(std::sqrt(P.back()) / 100));
  }
  const auto fit = fit_elastic(P, phi);
  ASSERT_EQ(fit.warnings.size(), 1u);
  EXPECT_THAT(fit.warnings[0], HasSubstr("curved"));
  EXPECT_NEAR(fit.secant_low, 100 / (std::sqrt(11.0) - std::sqrt(10.0)), 1e-9);
  EXPECT_NEAR(fit.secant_high, 100 / (std::sqrt(15.0) - std::sqrt(14.0)), 1e-9);
}

TEST(Elastic, OfACurvedBranchIsThatOfItsStraightPartOrNotIdentified) {
  // The first part of the unloading includes plastic strain; below P = 3 the unloading is elastic. The slope of a line
  // through all points would be wrong.
  std::vector<double> P = {13.0, 10.0, 7.0, 3.0, 2.0, 1.0, 0.5, 0.1}, phi;
  for (const double p : P)
    phi.push_back(0.77 * std::exp(p / 2.5e4 - 3e-6 * std::pow(std::max(p - 3.0, 0.0), 2)));
  const ElasticFit fit = fit_elastic(P, phi);
  EXPECT_TRUE(fit.is_curved);
  EXPECT_EQ(fit.first, 3);
  EXPECT_EQ(fit.n_points, 5);
  const FittedParameter& B = fit.parameters[0];
  EXPECT_NEAR(*B.value, 2.5e4, 1e-6 * 2.5e4);
  EXPECT_LE(*B.low95, 2.5e4);
  EXPECT_GE(*B.high95, 2.5e4);
  EXPECT_NEAR(*fit.parameters[1].value, 0.77, 1e-9);
  ElasticFit held = fit;
  hold_against(2.6e4, 2.4e4, held);
  EXPECT_TRUE(held.parameters[0].value);
  hold_against(3.6e4, 3.4e4, held);
  EXPECT_FALSE(held.parameters[0].value || held.parameters[0].low95 || held.parameters[0].identified);
  EXPECT_THAT(held.warnings.back(),
              HasSubstr("disagrees with the bulk moduli computed from the states of this part"));

  // ln Phi is proportional to the square root of P, so that no part of the branch is straight.
  phi.clear();
  for (const double p : P) phi.push_back(0.77 * std::exp(std::sqrt(p) / 100));
  const ElasticFit none = fit_elastic(P, phi);
  EXPECT_TRUE(none.found());
  for (const FittedParameter& p : none.parameters) EXPECT_FALSE(p.value || p.low95 || p.identified) << p.name;
  EXPECT_THAT(none.warnings.at(0), HasSubstr("not identified"));
}

TEST(Elastic, OfABranchWhoseBeginningCollapsesIsThatOfTheRest) {
  // In the first step the packing rearranges and becomes denser; all later steps are elastic.
  const std::vector<double> P = {13.0, 7.0, 3.0, 2.0, 1.0, 0.5, 0.1};
  std::vector<double> phi = {0.760};
  for (std::size_t k = 1; k < P.size(); ++k) phi.push_back(0.762 * std::exp(P[k] / 2.5e4));
  const ElasticFit fit = fit_elastic(P, phi);
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  EXPECT_EQ(fit.first, 1);
  EXPECT_EQ(fit.n_points, 6);
  EXPECT_NEAR(*fit.parameters[0].value, 2.5e4, 1e-6 * 2.5e4);
  EXPECT_THAT(fit.warnings.at(0),
              HasSubstr("its solid fraction grows as the pressure falls; B is the modulus of the "
                        "straight part of the branch, at pressures from 0.1 to 7"));
  // If the solid fraction also increases in a later step, no part of the branch counts as elastic.
  phi[5] = 0.9;
  EXPECT_THAT(fit_elastic(P, phi).failure_reason, HasSubstr("does not fall"));
}

TEST(Elastic, NoBranchIsRefusedInWords) {
  EXPECT_THAT(fit_elastic({2, 1}, {0.7, 0.69}).failure_reason, HasSubstr("2 pressures"));
  EXPECT_THAT(fit_elastic({3, 2, 1}, {0.7, 0.71, 0.72}).failure_reason, HasSubstr("does not fall"));
}

}  // namespace
}  // namespace floc
