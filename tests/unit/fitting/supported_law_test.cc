#include "floc/fitting/supported_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/infinity.h"
#include "support/coverage.h"
#include "support/synthetic_soil.h"

namespace floc::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

double value_in(const ConsolidationFit& fit, const std::string& name) {
  const FittedParameter* p = fit.find(name);
  return p && p->value ? *p->value : std::nan("");
}

ConsolidationCurve exact_curve(const std::function<double(double)>& phi_of,
                               const std::vector<double>& pressures) {
  RandomStream unused(0, 0);
  return noisy_curve(phi_of, pressures, {Noise::relative, 0.0}, unused);
}

double heckel(double P) {
  return 1.0 - std::exp(-0.55 - P / 85.0);
}

TEST(SupportedLaw, ARecompressionLineThatSlopesHasItsKappaAndYields) {
  const TwoLineClay clay;
  const auto fit = fit_supported_law(
      exact_curve([&](double P) { return 1.0 / clay.inverse_phi(P); }, geometric_pressures(6.0, 3072.0, 10)),
      {});
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  EXPECT_EQ(fit.law, ConsolidationLaw::log);
  EXPECT_NEAR(value_in(fit, "lambda"), clay.lambda, 1e-9);
  EXPECT_NEAR(value_in(fit, "kappa"), clay.kappa, 1e-9);
  EXPECT_NEAR(value_in(fit, "P0_star"), clay.P_yield, 1e-6);
  EXPECT_NEAR(value_in(fit, "Phi0"), 1.0 / clay.y_yield, 1e-9);
  EXPECT_NEAR(value_in(fit, "C_c"), std::log(10.0) * clay.lambda, 1e-8);
  EXPECT_NEAR(value_in(fit, "C_s"), std::log(10.0) * clay.kappa, 1e-8);
  EXPECT_EQ(fit.parameters[0].name, "lambda");
  EXPECT_EQ(fit.parameters[1].name, "kappa");
  EXPECT_TRUE(fit.warnings.empty() || fit.warnings.front().find("level") == std::string::npos);
}

TEST(SupportedLaw, IsTheFullLawWhereItIsIdentified) {
  for (const Published& set : {kNoRolling, kSmallRolling}) {
    const auto fit = fit_supported_law(set.with_plateau(), {});
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    EXPECT_EQ(fit.law, ConsolidationLaw::full);
    EXPECT_NEAR(value_in(fit, "lambda"), set.lambda, 1e-6);
    EXPECT_NEAR(value_in(fit, "P0_star"), set.P0_star, 1e-5);
    EXPECT_NEAR(value_in(fit, "kappa"), 0.0, 1e-8);
  }
}

TEST(SupportedLaw, OfAPlateauBeforeAPowerLawIsThePowerLaw) {
  const auto fit = fit_supported_law(
      exact_curve([](double P) { return 1.0 / (1.3 + 0.6 * std::pow(std::max(P, 0.1), -0.5)); },
                  geometric_pressures(0.01, 10.0, 25)),
      {});
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  EXPECT_EQ(fit.law, ConsolidationLaw::power);
  EXPECT_NEAR(value_in(fit, "alpha"), 0.5, 1e-6);
  EXPECT_NEAR(value_in(fit, "Phi_max"), 1.0 / 1.3, 1e-6);
}

TEST(SupportedLaw, IntervalsHoldTheTruth) {
  constexpr int kDraws = 200;
  const TwoLineClay clay;
  for (const Noise& noise : {Noise{Noise::of_inverse, 1e-3}, Noise{Noise::relative, 1e-3}}) {
    RandomStream random(5, 0);
    Coverage coverage({{"lambda", clay.lambda}, {"kappa", clay.kappa}, {"P0_star", clay.P_yield}});
    for (int draw = 0; draw < kDraws; ++draw)
      for (const FittedParameter& p :
           fit_supported_law(noisy_curve([&](double P) { return 1.0 / clay.inverse_phi(P); },
                                         geometric_pressures(10.0, 1000.0, 30), noise, random),
                             {})
               .parameters)
        coverage.add(p);
    coverage.expect_honest(kDraws, noise.kind == Noise::relative ? "relative noise" : "uniform noise");
  }
}

/// Curve of a recompression line up to P = 0.1, the line of regime II up to P = 30 and then a power law. The slope is
/// continuous at P = 30.
double three_regimes(double P) {
  constexpr double kAlpha = 0.5;
  const TwoLineClay clay{0.005, 0.08, 0.1, 2.0};
  if (P < 30.0) return 1.0 / clay.inverse_phi(P);
  const double y_onset = clay.inverse_phi(30.0), A = clay.lambda / kAlpha;
  return 1.0 / (y_onset - A + A * std::pow(P / 30.0, -kAlpha));
}

TEST(SupportedLaw, IsFoundInTablesOfThousandsOfRows) {
  RandomStream random(8, 0);
  for (const int n : {kMostPlaces + 1, 3000, 20000}) {
    const auto fit = fit_supported_law(
        noisy_curve(three_regimes, geometric_pressures(0.01, 1000.0, n), {Noise::of_inverse, 5e-4}, random),
        {});
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    EXPECT_EQ(fit.law, ConsolidationLaw::log);
    ASSERT_TRUE(fit.regimes && fit.regimes->plateau_end && fit.regimes->onset_three) << n;
    EXPECT_EQ(fit.n_plateau, fit.regimes->n_plateau);
    for (const auto& [name, truth] :
         {std::pair("lambda", 0.08), {"kappa", 0.005}, {"P0_star", 0.1}, {"alpha", 0.5}}) {
      const FittedParameter& p = *fit.find(name);
      ASSERT_TRUE(p.standard_error) << name << ", " << n;
      EXPECT_NEAR(*p.value, truth, 4.0 * *p.standard_error) << name << ", " << n;
    }
    EXPECT_NEAR(std::log(value_in(fit, "P1_star") / 30.0), 0.0, 0.3) << n;
  }
}

TEST(Regimes, GroupsAreMeansWithTheWeightOfTheirPoints) {
  LawPoints points{Eigen::VectorXd::LinSpaced(1203, 0.0, 6.0), {}, Eigen::VectorXd::LinSpaced(1203, 1.0, 2.0)};
  points.y = 2.0 - 0.1 * points.log_P.array();
  const GroupedPoints means = grouped(points);
  EXPECT_EQ(means.group_size, 3);
  ASSERT_EQ(means.points.size(), 401);
  EXPECT_LT((means.points.y.array() - 2.0 + 0.1 * means.points.log_P.array()).abs().maxCoeff(), 1e-14);
  EXPECT_NEAR(means.points.weight.squaredNorm(), points.weight.squaredNorm() / 3.0, 1e-9);
  const LawPoints few = points.range(0, kMostPlaces);
  EXPECT_EQ(grouped(few).group_size, 1);
  EXPECT_EQ(grouped(few).points.y, few.y);
}

TEST(PhiLimit, IsReportedAsABoundWhereTheFitWouldGoBeyond) {
  std::vector<double> pressures = {2.0, 5.0};
  for (int k = 1; k <= 42; ++k) pressures.push_back(10.0 * k);
  const ConsolidationCurve tablet = exact_curve(heckel, pressures);
  const auto fit = fit_consolidation(tablet, {});
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  const FittedParameter& phi_max = *fit.find("Phi_max");
  EXPECT_FALSE(phi_max.identified);
  EXPECT_FALSE(phi_max.value);
  EXPECT_EQ(phi_max.high95, 1.0);
  EXPECT_LT(*phi_max.low95, 1.0);
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("at its bound, 1")));
  EXPECT_TRUE(fit.pattern.is_systematic());

  ConsolidationOptions open;
  open.phi_limit = kInfinity;
  EXPECT_NEAR(value_in(fit_consolidation(tablet, open), "Phi_max"), 1.0171, 1e-4);
  ConsolidationOptions lower;
  lower.phi_limit = 0.772;
  EXPECT_EQ(fit_consolidation(kSmallRolling.with_plateau(), lower).find("Phi_max")->high95, 0.772);
}

/// Fits noisy copies of a curve. Returns how many of the fits report that the law does not describe the curve.
int n_denied(const std::function<double(double)>& phi_of, double low, double high,
             const ConsolidationOptions& options, int n_draws) {
  RandomStream random(9, 0);
  int n = 0;
  for (int draw = 0; draw < n_draws; ++draw) {
    const auto fit = fit_consolidation(
        noisy_curve(phi_of, geometric_pressures(low, high, 30), {Noise::of_fraction, 1e-3}, random), options);
    n += fit.found() && fit.pattern.is_systematic();
  }
  return n;
}

TEST(ResidualsOfALaw, TellWhetherItIsThatOfTheCurve) {
  constexpr int kDraws = 40;
  ConsolidationOptions full, log;
  log.law = ConsolidationLaw::log;
  const TwoLineClay clay;
  const auto of_clay = [&](double P) { return 1.0 / clay.inverse_phi(P); };
  const auto law = kSmallRolling.law();
  EXPECT_GE(n_denied(heckel, 4.0, 400.0, full, kDraws), 0.95 * kDraws);
  EXPECT_GE(n_denied(of_clay, 10.0, 1000.0, log, kDraws), 0.95 * kDraws);
  EXPECT_GE(n_denied(of_clay, 10.0, 1000.0, full, kDraws), 0.95 * kDraws);
  EXPECT_LE(n_denied([&](double P) { return 1.0 / law.inverse_phi(P); }, 0.0316, 3.16, full, kDraws), 2);
}

}  // namespace
}  // namespace floc::test
