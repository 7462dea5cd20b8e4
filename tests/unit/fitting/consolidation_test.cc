#include "floc/fitting/consolidation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/base/random.h"
#include "floc/fitting/consolidation_law.h"
#include "floc/fitting/student_t.h"
#include "support/published_consolidation.h"

namespace floc {
namespace {

using test::curve_of;
using test::kNoRolling;
using test::kSmallRolling;
using test::Published;
using test::published_pressures;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

ConsolidationOptions on(double low, double high, ConsolidationLaw law = ConsolidationLaw::full) {
  ConsolidationOptions options;
  options.law = law;
  options.window = {low, high};
  return options;
}

double value(const ConsolidationFit& fit, const std::string& name) {
  const FittedParameter* p = fit.find(name);
  return p && p->value ? *p->value : std::nan("");
}

TEST(ConsolidationLaw, MatchesThePrintedFormWhereThatKeepsItsDigits) {
  const auto law = kNoRolling.law();
  for (const double P : {0.03, 0.1, 0.3, 1.0, 2.0}) {
    const double u = std::pow(law.P1_star / P, law.alpha);
    const double printed =
        1 / kNoRolling.phi0 -
        law.lambda * std::log(P / kNoRolling.P0_star * std::pow(1 - std::exp(-u), 1 / law.alpha));
    // For u << 1, the term 1 - exp(-u) of the printed form is a small difference of large terms. The subtraction
    // multiplies rounding errors by about 1/u.
    EXPECT_NEAR(law.inverse_phi(P), printed, 1e-14);
  }
}

TEST(ConsolidationLaw, TendsToRegimeTwoAndRegimeThreeOverTwentyFourDecades) {
  const auto law = kSmallRolling.law();
  const double A = law.lambda * std::pow(law.P1_star, law.alpha) / (2 * law.alpha);
  for (int k = -12; k <= -3; ++k) {
    const double P = law.P1_star * std::pow(10.0, k);
    const double line = 1 / kSmallRolling.phi0 - law.lambda * std::log(P / kSmallRolling.P0_star);
    EXPECT_NEAR(law.inverse_phi(P), line, 1e-14 * line) << k;
  }
  for (int k = 3; k <= 12; ++k) {
    const double P = law.P1_star * std::pow(10.0, k);
    const double u = std::pow(10.0, -k * law.alpha);
    const double beyond = -law.lambda * consolidation_bracket(std::log(P / law.P1_star), law.alpha);
    // The compared value is the first term of an expansion in u; the next term is u/12 times as large. pow() has
    // rounding errors of 1e-12 at these arguments.
    EXPECT_NEAR(beyond / (A * std::pow(P, -law.alpha)), 1.0, u / 12 * 1.01 + 1e-12) << k;
  }
}

/// Curve of a natural clay: two lines with slopes of 0.035 and 0.22, which meet at P = 170.
TEST(Consolidation, WarnsOfAPlateauThatFallsAndNamesWhereTheLinesMeet) {
  const auto warnings_with = [](double slope) {
    ConsolidationCurve curve;
    for (int k = 0; k < 10; ++k) {
      const double P = 6.0 * std::pow(2.0, k);
      curve.P_star.push_back(P);
      curve.phi.push_back(1.0 / (2.3 - (P < 170.0 ? slope : 0.22) * std::log(P / 170.0)));
    }
    return fit_consolidation(curve, {}).warnings;
  };
  EXPECT_THAT(warnings_with(0.035),
              Contains(HasSubstr("1/Phi falls by 0.035 for each unit of ln P* there, which is 16 % of lambda; "
                                 "lines through the plateau and through regime II meet at P* = 170")));
  EXPECT_THAT(warnings_with(0.01), Not(Contains(HasSubstr("not level"))));
}

TEST(ConsolidationLaw, IsSmoothWhereItsFormsMeet) {
  for (const double alpha : {0.5, 1.0, 3.0})
    for (const double u : {0.1, 1.0, std::exp(6.7)}) {
      const double x = -std::log(u) / alpha;
      const double step = 1e-9;
      const double below = consolidation_bracket(x - step, alpha);
      const double above = consolidation_bracket(x + step, alpha);
      // Below and above each u, the law is computed by different formulas. The slope of the law is at most 1. The
      // change over two steps therefore exceeds 2 steps plus rounding only if the two formulas disagree.
      EXPECT_GE(above, below);
      EXPECT_LE(above - below, 2 * step + 1e-14);
    }
}

TEST(StudentT, AgreesWithItsClosedFormsAndTable) {
  EXPECT_NEAR(student_t_95(1), std::tan(0.475 * std::numbers::pi), 1e-10);
  EXPECT_NEAR(student_t_95(2), 0.95 * std::sqrt(2 / (1 - 0.95 * 0.95)), 1e-12);
  EXPECT_NEAR(student_t_95(20), 2.0859634, 1e-7);
  EXPECT_NEAR(student_t_95(19), 2.0930241, 1e-7);
}

TEST(FitConsolidation, RecoversThePublishedSetsExactly) {
  for (const Published& set : {kNoRolling, kSmallRolling}) {
    const auto fit =
        fit_consolidation(curve_of(set.law(), published_pressures(set.P0_star)), on(set.P0_star, 13.34));
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    EXPECT_NEAR(value(fit, "lambda"), set.lambda, 1e-8);
    EXPECT_NEAR(value(fit, "alpha"), set.alpha, 1e-8);
    EXPECT_NEAR(value(fit, "Phi_max"), set.phi_max, 1e-8);
    EXPECT_NEAR(value(fit, "P0_star"), published_pressures(set.P0_star).front(), 1e-15);
    const double P0 = value(fit, "P0_star");
    const double on_line = 1 / set.phi0 - set.lambda * std::log(P0 / set.P0_star);
    EXPECT_NEAR(value(fit, "Phi0"), 1 / on_line, 1e-8);
    EXPECT_NEAR(std::log(value(fit, "P1_star") / P0),
                (1 / value(fit, "Phi0") - 1 / value(fit, "Phi_max")) / value(fit, "lambda"), 1e-10);
    EXPECT_LT(fit.rms, 1e-10);
    EXPECT_TRUE(fit.warnings.empty()) << fit.warnings.front();
  }
}

TEST(FitConsolidation, RecoversAnyIdentifiedSetExactly) {
  RandomStream random(7, 0);
  for (int k = 0; k < 200; ++k) {
    const ConsolidationLawParameters law{random.uniform(0.05, 0.5), random.uniform(0.6, 1.8),
                                         random.uniform(0.7, 0.85), random.uniform(0.2, 2.0)};
    const auto fit = fit_consolidation(curve_of(law, published_pressures(0.01)), on(0.01, 14));
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    EXPECT_NEAR(value(fit, "lambda"), law.lambda, 1e-8) << k;
    EXPECT_NEAR(value(fit, "alpha"), law.alpha, 1e-8) << k;
    EXPECT_NEAR(value(fit, "Phi_max"), law.phi_max, 1e-8) << k;
    EXPECT_NEAR(value(fit, "P1_star"), law.P1_star, 1e-8) << k;
  }
}

/// Returns a curve that follows the law above P0* and has the constant solid fraction of regime I below P0*.
/// The values of 1/Phi have normally distributed errors.
/// @param noise  standard deviation of the errors
ConsolidationCurve with_plateau(const Published& set, double noise, RandomStream& random) {
  ConsolidationCurve curve = curve_of(set.law(), published_pressures(0.01));
  for (std::size_t i = 0; i < curve.phi.size(); ++i) {
    const double y =
        curve.P_star[i] < 0.999 * set.P0_star ? set.law().inverse_phi(set.P0_star) : 1 / curve.phi[i];
    curve.phi[i] = 1 / (y + noise * random.normal());
  }
  return curve;
}

TEST(FitConsolidation, FindsTheEndOfThePlateau) {
  RandomStream random(1, 0);
  for (const Published& set : {kNoRolling, kSmallRolling}) {
    const auto fit = fit_consolidation(with_plateau(set, 0.0, random), {});
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    // P0* is 0.01 * 10^(3/8) or 0.01 * 10^(4/8), so three or four pressures of the curve lie below P0*. The fit may
    // assign the point at P0* to the plateau or to the law.
    const int before = set.P0_star < 0.03 ? 3 : 4;
    EXPECT_GE(fit.n_plateau, before);
    EXPECT_LE(fit.n_plateau, before + 1);
    EXPECT_NEAR(value(fit, "lambda"), set.lambda, 1e-8);
    // The plateau of the curve ends at the published P0*, which is rounded to three digits.
    EXPECT_NEAR(value(fit, "P0_star"), set.P0_star, 1e-3 * set.P0_star);
  }
}

TEST(FitConsolidation, ThePlateauEndsWhereTheLawReachesItsLevel) {
  // In this curve the plateau is too long: it extends up to P* = 0.1, where Phi jumps to the exact law. The line of the
  // law, extended to lower pressures, reaches the level of the plateau far below 0.1.
  ConsolidationCurve jump = curve_of(kNoRolling.law(), published_pressures(0.01));
  for (std::size_t i = 0; i < 9; ++i) jump.phi[i] = kNoRolling.phi0;
  const auto fit = fit_consolidation(jump, {});
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  EXPECT_LT(fit.n_plateau, 9);
  EXPECT_GT(value(fit, "P0_star"), fit.plateau_high / 2);
  EXPECT_LT(value(fit, "P0_star"), 2 * fit.window_low);
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("lambda depends on the window")));
}

TEST(FitConsolidation, WithoutAPlateauEveryPointIsFitted) {
  const auto fit = fit_consolidation(curve_of(kNoRolling.law(), published_pressures(0.02)), {});
  ASSERT_TRUE(fit.found());
  EXPECT_EQ(fit.n_plateau, 0);
  EXPECT_EQ(fit.used.size(), published_pressures(0.02).size());
}

TEST(FitConsolidation, StatedErrorsAreTheScatterOfRepeatedFits) {
  constexpr int kRepeats = 400;
  constexpr double kNoise = 0.005;
  const auto law = kSmallRolling.law();
  const auto exact = curve_of(law, published_pressures(kSmallRolling.P0_star));
  RandomStream random(3, 0);
  double sum = 0, squares = 0, stated = 0;
  int covered = 0;
  for (int k = 0; k < kRepeats; ++k) {
    ConsolidationCurve curve = exact;
    for (double& phi : curve.phi) phi = 1 / (1 / phi + kNoise * random.normal());
    ConsolidationOptions options = on(0.03, 14);
    options.weighting = Weighting::uniform;
    const auto fit = fit_consolidation(curve, options);
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    const FittedParameter& p = *fit.find("lambda");
    sum += *p.value;
    squares += *p.value * *p.value;
    stated += *p.standard_error;
    covered += *p.low95 <= law.lambda && law.lambda <= *p.high95;
  }
  const double mean = sum / kRepeats;
  const double scatter = std::sqrt(squares / kRepeats - mean * mean);
  // The standard deviation of 400 repeats has a standard error of 3.5 %. The fraction of intervals that contain the
  // true value has a standard error of 1.1 %.
  EXPECT_NEAR(stated / kRepeats / scatter, 1.0, 0.14);
  EXPECT_NEAR(covered / double{kRepeats}, 0.95, 0.044);
}

TEST(FitConsolidation, DataThatEndBeforeRegimeThreeBoundItOnly) {
  const auto law = kNoRolling.law();
  std::vector<double> pressures;
  for (int k = 0; k <= 16; ++k) pressures.push_back(law.P1_star * std::pow(10.0, -3.0 + k / 8.0));
  ConsolidationCurve curve = curve_of(law, pressures);
  RandomStream random(5, 0);
  for (double& phi : curve.phi) phi = 1 / (1 / phi + 1e-3 * random.normal());
  const auto fit = fit_consolidation(curve, on(1e-6, 1.0));
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  for (const char* name : {"alpha", "P1_star", "Phi_max"}) {
    EXPECT_FALSE(fit.find(name)->identified) << name;
    EXPECT_FALSE(fit.find(name)->value) << name;
  }
  EXPECT_EQ(fit.find("P1_star")->low95, pressures.back());
  EXPECT_LT(*fit.find("P1_star")->low95, law.P1_star);
  EXPECT_LT(*fit.find("Phi_max")->low95, law.phi_max);
  EXPECT_NEAR(value(fit, "lambda"), law.lambda, 5 * *fit.find("lambda")->standard_error);
  ASSERT_EQ(fit.warnings.size(), 1u);
  EXPECT_THAT(fit.warnings[0], HasSubstr("before regime III begins at P1*"));
}

TEST(FitConsolidation, ASharpKneeLeavesAlphaOpenAndTheRestKnown) {
  // These data follow a line in ln P down to a constant value of 1/Phi; the corner lies between two pressures of the
  // data. The law describes the data equally well with every large alpha, so alpha is not determined.
  RandomStream random(4, 0);
  ConsolidationCurve knee;
  for (const double P : published_pressures(0.01)) {
    knee.P_star.push_back(P);
    knee.phi.push_back(1 / (std::max(1.3, 2.0 - 0.2 * std::log(P / 0.01)) + 1e-5 * random.normal()));
  }
  const auto fit = fit_consolidation(knee, on(0.01, 14));
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  EXPECT_FALSE(fit.find("alpha")->identified);
  for (const char* name : {"lambda", "Phi_max"}) EXPECT_TRUE(fit.find(name)->identified) << name;
  EXPECT_NEAR(value(fit, "lambda"), 0.2, 1e-3);
  EXPECT_NEAR(value(fit, "Phi_max"), 1 / 1.3, 1e-4);
}

TEST(FitConsolidation, LogAndPowerLawsRecoverTheirOwnData) {
  ConsolidationCurve line, power;
  for (const double P : published_pressures(0.01)) {
    line.P_star.push_back(P);
    line.phi.push_back(1 / (2.2 - 0.15 * std::log(P / 0.01)));
    power.P_star.push_back(P);
    power.phi.push_back(1 / (1.25 + 0.07 * std::pow(P, -0.8)));
  }
  const auto log_fit = fit_consolidation(line, on(0.01, 14, ConsolidationLaw::log));
  EXPECT_NEAR(value(log_fit, "lambda"), 0.15, 1e-10);
  EXPECT_NEAR(value(log_fit, "Phi0"), 1 / 2.2, 1e-10);
  const auto power_fit = fit_consolidation(power, on(0.01, 14, ConsolidationLaw::power));
  EXPECT_NEAR(value(power_fit, "A"), 0.07, 1e-8);
  EXPECT_NEAR(value(power_fit, "alpha"), 0.8, 1e-8);
  EXPECT_NEAR(value(power_fit, "Phi_max"), 0.8, 1e-8);
}

TEST(FitConsolidation, LawsOfOneRegimeStayInIt) {
  RandomStream random(1, 0);
  const auto law = kNoRolling.law();
  ConsolidationOptions options;
  options.law = ConsolidationLaw::log;
  const auto log_fit = fit_consolidation(with_plateau(kNoRolling, 0.0, random), options);
  ASSERT_TRUE(log_fit.found()) << log_fit.failure_reason;
  EXPECT_LT(log_fit.window_high, law.P1_star);
  // The line is fitted up to the pressure where a power law fits better. The slope of the line then agrees with
  // lambda within a few per cent.
  EXPECT_NEAR(value(log_fit, "lambda"), law.lambda, 0.05 * law.lambda);
  options.law = ConsolidationLaw::power;
  const auto power_fit = fit_consolidation(with_plateau(kNoRolling, 0.0, random), options);
  ASSERT_TRUE(power_fit.found()) << power_fit.failure_reason;
  EXPECT_GT(power_fit.window_low, log_fit.window_high);
  // Both laws are first terms of expansions of the full law. The power law neglects terms of the relative order
  // u/12, with u = (P1*/P*)^alpha of order one.
  EXPECT_NEAR(value(power_fit, "Phi_max"), law.phi_max, 0.01 * law.phi_max);
}

TEST(FitConsolidation, AFullLawWithoutRegimeTwoIsThePowerLaw) {
  // Mean curve of four paths, steep at the start: values of 1/Phi and weights at equal steps of 0.288 in ln P*. In the
  // best full law, P1* is far below the first pressure. At the pressures of the data, this law equals a power law.
  const std::vector<double> y = {2.016, 1.933, 1.918, 1.729, 1.625, 1.483, 1.483, 1.476,
                                 1.459, 1.398, 1.380, 1.378, 1.351, 1.332, 1.327, 1.315,
                                 1.298, 1.294, 1.293, 1.285, 1.282, 1.276, 1.273};
  const std::vector<double> weight = {0.30, 0.27, 0.25, 0.27, 0.27, 0.29, 0.38, 0.90, 0.92, 0.95, 0.94, 1.08,
                                      1.37, 1.37, 1.37, 1.37, 1.37, 1.37, 1.37, 1.37, 1.37, 1.37, 1.37};
  LawPoints points{Eigen::VectorXd::LinSpaced(23, -3.742, 2.59),
                   Eigen::Map<const Eigen::VectorXd>(y.data(), 23),
                   Eigen::Map<const Eigen::VectorXd>(weight.data(), 23)};
  const auto full = solve_law(ConsolidationLaw::full, points),
             power = solve_law(ConsolidationLaw::power, points);
  ASSERT_TRUE(full && power);
  EXPECT_LT(full->theta[3], points.log_P[0]);
  EXPECT_NEAR(full->sum_of_squares, power->sum_of_squares, 1e-6 * power->sum_of_squares);
}

TEST(FitConsolidation, TooLittleIsRefusedInWords) {
  const auto curve = curve_of(kNoRolling.law(), published_pressures(0.01));
  EXPECT_THAT(fit_consolidation(curve, on(0.03, 0.05, ConsolidationLaw::log)).failure_reason,
              HasSubstr("there are 2 pressures in regime II, but a fit of the log law needs 3"));
  EXPECT_THAT(fit_consolidation(curve, on(100, 200)).failure_reason, HasSubstr("0 pressures in the window"));
  EXPECT_THAT(fit_consolidation({{1.0, 2.0}, {0.5, 0.6}, {}}, {}).failure_reason, HasSubstr("2 pressures"));
  ConsolidationCurve falling = curve;
  std::reverse(falling.phi.begin(), falling.phi.end());
  EXPECT_THAT(fit_consolidation(falling, on(0.01, 14)).failure_reason, HasSubstr("does not grow"));
  EXPECT_FALSE(fit_consolidation(falling, {}).found());
}

TEST(FitConsolidation, CorrelationHasUnitDiagonalAndIsSymmetric) {
  RandomStream random(2, 0);
  const auto fit = fit_consolidation(with_plateau(kSmallRolling, 0.003, random), {});
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  EXPECT_THAT(fit.correlated, ElementsAre("lambda", "alpha", "Phi_max", "P1_star"));
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(fit.correlation(i, i), 1.0, 1e-12);
    for (int j = 0; j < i; ++j) EXPECT_NEAR(fit.correlation(i, j), fit.correlation(j, i), 1e-12);
  }
  // If the start of regime II is fixed, a law with a larger lambda reaches its limiting density at a lower pressure
  // P1*.
  EXPECT_LT(fit.correlation(0, 3), 0.0);
}

}  // namespace
}  // namespace floc
