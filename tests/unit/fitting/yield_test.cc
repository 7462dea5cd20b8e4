#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/fitting/preconsolidation.h"
#include "floc/fitting/smoothing_spline.h"
#include "floc/fitting/yield_constructions.h"
#include "support/coverage.h"
#include "support/synthetic_soil.h"

namespace floc::test {
namespace {

constexpr double kKappa = 0.02, kLambda = 0.2, kPc = 1.7;

/// Curve with a bend that is rounded by ln[1 + (P/P_c)^sharpness]/sharpness. With infinite sharpness, the bend
/// is sharp.
struct Bent {
  std::vector<double> P, phi;

  Bent(double sharpness, double noise, int n, RandomStream& random)
      : P(geometric_pressures(0.05 * kPc, 20 * kPc, n)) {
    for (const double p : P) {
      const double x = std::log(p / kPc);
      const double bend = std::isinf(sharpness)
                              ? std::max(x, 0.0)
                              : std::max(x, 0.0) + std::log1p(std::exp(-sharpness * std::abs(x))) / sharpness;
      phi.push_back(1.0 / (1.6 - kKappa * x - (kLambda - kKappa) * bend + noise * random.normal()));
    }
  }
};

const FittedParameter* find(const PreconsolidationFit& fit, const std::string& name) {
  for (const FittedParameter& p : fit.parameters)
    if (p.name == name) return &p;
  return nullptr;
}

TEST(SmoothingSpline, ReproducesStraightLinesAndDerivativesOfSmoothCurves) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(40, 0.0, 3.0);
  const Eigen::VectorXd line = 2.0 - 0.7 * x.array();
  const SmoothingSpline of_line(x, line);
  EXPECT_LT((of_line.smoother() * line - line).norm(), 1e-10);
  const Eigen::VectorXd sine = x.array().sin();
  const SmoothingSpline of_sine(x, sine);
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(17, 0.8, 2.2);
  const auto o = of_sine.operators(at);
  EXPECT_LT((o.value * sine - at.array().sin().matrix()).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((o.slope * sine - at.array().cos().matrix()).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT((o.curvature * sine + at.array().sin().matrix()).cwiseAbs().maxCoeff(), 2e-2);
}

TEST(SmoothingSpline, TakesNoiseOutOfASmoothCurve) {
  RandomStream random(3, 0);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(60, 0.0, 6.0);
  const Eigen::VectorXd exact = x.array().sin();
  const Eigen::VectorXd noisy = exact + Eigen::VectorXd::NullaryExpr(60, [&] { return 0.1 * random.normal(); });
  const SmoothingSpline spline(x, noisy);
  EXPECT_LT((spline.smoother() * noisy - exact).norm(), 0.6 * (noisy - exact).norm());
}

TEST(Preconsolidation, IntervalsHoldTheTruthAtRoundBendsToo) {
  constexpr int kDraws = 100;
  for (const double sharpness : {HUGE_VAL, 8.0, 3.0}) {
    RandomStream random(2, 0);
    Coverage coverage({{"P_c", kPc}, {"kappa", kKappa}, {"lambda", kLambda}});
    for (int draw = 0; draw < kDraws; ++draw) {
      const Bent curve(sharpness, 2e-3, 20, random);
      const PreconsolidationFit fit = fit_preconsolidation(curve.P, curve.phi);
      ASSERT_TRUE(fit.found()) << fit.failure_reason;
      for (const FittedParameter& p : fit.parameters) coverage.add(p);
    }
    coverage.expect_honest(kDraws, "sharpness " + std::to_string(sharpness));
  }
}

TEST(Yield, ByAllConstructionsIsThatOfTwoLines) {
  RandomStream random(4, 0);
  const Bent curve(HUGE_VAL, 1e-3, 30, random);
  const PreconsolidationFit fit = fit_preconsolidation(curve.P, curve.phi);
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  EXPECT_NEAR(std::log(*find(fit, "P_c")->value / kPc), 0.0, 0.03);
  // Butterfield plots ln y against ln P. This plot is straight, up to terms of second order in the slope, where y is
  // linear in ln P. Becker plots the work against P. His plot is linear in the same range. His construction uses only
  // the pressures of the data, which differ by 22 %.
  for (const char* name : {"P_c_butterfield", "P_c_becker"})
    EXPECT_NEAR(std::log(*find(fit, name)->value / kPc), 0.0, 0.2) << name;
  // If kappa > 0, the bisector of Casagrande and the horizontal line of Pacheco Silva meet the virgin line at a
  // pressure above the bend.
  for (const char* name : {"P_c_casagrande", "P_c_pacheco_silva"}) {
    EXPECT_NEAR(std::log(*find(fit, name)->value / kPc), 0.1, 0.3) << name;
    EXPECT_LT(*find(fit, name)->low95, *find(fit, name)->value);
    EXPECT_GT(*find(fit, name)->high95, *find(fit, name)->value);
  }
  ASSERT_NE(find(fit, "P_c_agreed"), nullptr);
}

TEST(Yield, BootstrapIntervalsAreTheScatterOfRepeatedCurves) {
  constexpr int kDraws = 60;
  RandomStream random(6, 0);
  std::vector<double> logs, widths;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Bent curve(8.0, 2e-3, 25, random);
    const PreconsolidationFit fit = fit_preconsolidation(curve.P, curve.phi);
    const FittedParameter* becker = find(fit, "P_c_becker");
    ASSERT_TRUE(becker && becker->value);
    logs.push_back(std::log(*becker->value));
    widths.push_back(std::log(*becker->high95 / *becker->low95) / 3.92);
  }
  const Eigen::Map<const Eigen::ArrayXd> x(logs.data(), kDraws), w(widths.data(), kDraws);
  const double scatter = std::sqrt((x - x.mean()).square().sum() / (kDraws - 1));
  EXPECT_NEAR(w.mean() / scatter, 1.0, 0.4);
}

TEST(AgreedPressure, IsSharedByAllIntervals) {
  const auto of = [](double value, double low, double high) {
    return FittedParameter{"P_c_x", value, 0.1, low, high, true};
  };
  const FittedParameter agreed = agreed_pressure({of(1.0, 0.8, 1.2), of(1.1, 0.9, 1.4), of(1.3, 1.1, 1.6)});
  EXPECT_EQ(agreed.low95, 1.1);
  EXPECT_EQ(agreed.high95, 1.2);
  EXPECT_EQ(agreed.value, 1.1);
  EXPECT_FALSE(agreed_pressure({of(1.0, 0.9, 1.1), of(1.5, 1.4, 1.6), of(1.0, 0.8, 1.2)}).value);
  EXPECT_FALSE(agreed_pressure({of(1.0, 0.9, 1.1), of(1.0, 0.8, 1.2)}).value);
}

}  // namespace
}  // namespace floc::test
