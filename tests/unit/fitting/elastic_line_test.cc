#include "floc/fitting/elastic_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  ASSERT_TRUE(fit.found()) << fit.refusal;
  // Phi is known to 1e-16 and changes by 5e-4.
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
  // 200 repeats of probability 0.95: outside 180 to 198 in one of two hundred.
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

TEST(Elastic, NoBranchIsRefusedInWords) {
  EXPECT_THAT(fit_elastic({2, 1}, {0.7, 0.69}).refusal, HasSubstr("2 pressures"));
  EXPECT_THAT(fit_elastic({3, 2, 1}, {0.7, 0.71, 0.72}).refusal, HasSubstr("does not fall"));
}

}  // namespace
}  // namespace floc
