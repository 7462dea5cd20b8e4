#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "floc/fitting/correlated_mean.h"
#include "floc/fitting/mohr_coulomb.h"
#include "floc/fitting/oedometer_test.h"
#include "floc/fitting/shear_test.h"

namespace floc {
namespace {

using testing::HasSubstr;

double in_radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// Returns the axial stress at failure under the lateral stress `minor`.
double failure_stress(double angle, double cohesion, double minor) {
  const double sine = std::sin(in_radians(angle)), N = (1 + sine) / (1 - sine);
  return N * minor + 2 * cohesion * std::sqrt(N);
}

const FittedParameter& parameter_named(const std::vector<FittedParameter>& all, const std::string& name) {
  for (const FittedParameter& p : all)
    if (p.name == name) return p;
  throw std::runtime_error("no parameter " + name);
}

bool contains_truth(const FittedParameter& p, double truth) {
  return *p.low95 <= truth && truth <= *p.high95;
}

TEST(MohrCoulomb, ExactStressesGiveBackAngleAndCohesion) {
  for (const double angle : {5.0, 22.0, 38.0, 60.0})
    for (const double cohesion : {0.0, 15.0}) {
      std::vector<FailureStress> stresses;
      for (const double minor : {50.0, 100.0, 200.0, 400.0})
        stresses.push_back({failure_stress(angle, cohesion, minor), minor});
      const MohrCoulombFit fit = fit_mohr_coulomb(stresses, "_peak");
      ASSERT_TRUE(fit.found()) << fit.failure_reason;
      EXPECT_EQ(fit.angle.name, "friction_angle_peak");
      EXPECT_NEAR(*fit.angle.value, angle, 1e-9);
      EXPECT_NEAR(*fit.cohesion.value, cohesion, 1e-9);
      EXPECT_LT(*fit.angle.standard_error, 1e-9);
    }
}

TEST(MohrCoulomb, IntervalsHoldTheTruthAsOftenAsTheySay) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 2000;
  for (const int per_stress : {1, 3}) {
    int angle = 0, cohesion = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      std::vector<FailureStress> stresses;
      for (const double minor : {50.0, 100.0, 200.0, 400.0})
        for (int k = 0; k < per_stress; ++k)
          stresses.push_back({failure_stress(33, 12, minor) * (1 + 0.03 * normal(random)), minor});
      const MohrCoulombFit fit = fit_mohr_coulomb(stresses, "");
      angle += contains_truth(fit.angle, 33);
      cohesion += contains_truth(fit.cohesion, 12);
    }
    for (const int held : {angle, cohesion}) {
      EXPECT_GE(held, 0.935 * kDraws) << per_stress;
      EXPECT_LE(held, 0.965 * kDraws) << per_stress;
    }
  }
}

TEST(MohrCoulomb, TestsThatHaveNoLineSayWhy) {
  EXPECT_THAT(fit_mohr_coulomb({{300, 100}, {600, 200}}, "").failure_reason, HasSubstr("there are 2 tests"));
  EXPECT_THAT(fit_mohr_coulomb({{300, 100}, {310, 101}, {305, 102}}, "").failure_reason,
              HasSubstr("differ by less than 5 %"));
  EXPECT_THAT(fit_mohr_coulomb({{300, 100}, {310, 200}, {305, 300}}, "").failure_reason,
              HasSubstr("no friction angle"));
  EXPECT_THAT(fit_mohr_coulomb_planes({{100, -50}, {200, -100}, {300, -150}}, "").failure_reason,
              HasSubstr("a test failed at the shear stress -150"));
  // An envelope that bends upwards gives a line with a negative cohesion. This cannot happen if the envelope bends
  // downwards.
  EXPECT_THAT(fit_mohr_coulomb({{120, 50}, {300, 100}, {660, 200}, {1380, 400}}, "").warnings,
              testing::ElementsAre(HasSubstr("the cohesion of the line is negative")));
}

TEST(MohrCoulomb, SecantAngleOfAThreefoldStressIsThirtyDegrees) {
  EXPECT_NEAR(secant_angle({3.0, 1.0}), 30.0, 1e-12);
  EXPECT_EQ(secant_angle({2.0, 2.0}), 0.0);
}

/// Returns a drained test under the lateral stress 100. The sine of the mobilised friction angle rises to
/// `peak` at a strain of 0.02 and then falls to `critical`. The sample dilates with the angle psi up to a
/// strain of 0.1.
/// @param sign  1 for compression, -1 for extension
std::vector<ShearPoint> drained_test(double peak, double critical, double psi, double sign = 1.0) {
  std::vector<ShearPoint> points;
  const double sine = std::sin(in_radians(psi));
  const double slope = sign > 0 ? -2 * sine / (1 - sine) : -2 * sine / (1 + sine);
  for (int k = 0; k <= 200; ++k) {
    const double strain = 0.001 * k;
    const double rise = peak * (1 - std::pow(1 - std::min(strain / 0.02, 1.0), 2));
    const double mobilised =
        strain < 0.02 ? rise : critical + (peak - critical) * std::exp(-(strain - 0.02) / 0.02);
    const double ratio = (1 + mobilised) / (1 - mobilised);
    ShearPoint p;
    p.lateral_stress = 100;
    p.axial_stress = sign > 0 ? 100 * ratio : 100 / ratio;
    p.axial_strain = sign * strain;
    p.volumetric_strain = slope * std::min(strain, 0.1);
    points.push_back(p);
  }
  return points;
}

TEST(ShearTest, GivesBackItsAnglesInCompressionAndExtension) {
  for (const double sign : {1.0, -1.0}) {
    const ShearTest test = evaluate_shear_test(drained_test(0.6, 0.4, 12, sign), {});
    ASSERT_TRUE(test.found()) << test.failure_reason;
    EXPECT_NEAR(*parameter_named(test.parameters, "secant_angle_peak").value,
                std::asin(0.6) * 180 / std::numbers::pi, 1e-9);
    EXPECT_NEAR(*parameter_named(test.parameters, "strain_peak").value, 0.02, 1e-12);
    EXPECT_NEAR(*parameter_named(test.parameters, "dilatancy_angle").value, 12, 1e-9);
    // Beyond a strain of 0.15, less than the fraction exp(-6.5) of the decrease from the peak to the critical state
    // remains.
    EXPECT_NEAR(*parameter_named(test.parameters, "secant_angle_critical").value,
                std::asin(0.4) * 180 / std::numbers::pi, 0.02);
    ASSERT_TRUE(test.critical_stress.has_value());
    EXPECT_NEAR(test.critical_stress->major / test.critical_stress->minor, 1.4 / 0.6, 2e-3);
  }
}

TEST(ShearTest, StillDilatingHasNoCriticalState) {
  std::vector<ShearPoint> points = drained_test(0.6, 0.4, 12);
  points.resize(80);
  const ShearTest test = evaluate_shear_test(points, {});
  EXPECT_FALSE(test.critical_stress.has_value());
  EXPECT_THAT(test.warnings, testing::ElementsAre(HasSubstr("has not reached a critical state")));
  EXPECT_FALSE(evaluate_shear_test(drained_test(0.6, 0.4, 12), {0.05, false}).critical_stress.has_value());
  EXPECT_TRUE(evaluate_shear_test(drained_test(0.6, 0.4, 12), {0.12, false}).critical_stress.has_value());
  EXPECT_THAT(evaluate_shear_test({{}, {}}, {}).failure_reason, HasSubstr("it has 2 states"));
}

TEST(ShearTest, UndrainedHasItsStrengthAndPorePressure) {
  std::vector<ShearPoint> points;
  for (int k = 0; k <= 100; ++k) {
    // The test starts from an isotropic stress of 100. Up to a strain of 0.1, the lateral effective stress
    // falls to 40 and the deviator rises to 60.
    const double part = std::min(1.0, k / 50.0);
    ShearPoint p;
    p.axial_strain = 0.002 * k;
    p.lateral_stress = 100 - 60 * part;
    p.axial_stress = p.lateral_stress + 60 * part;
    points.push_back(p);
  }
  const ShearTest test = evaluate_shear_test(points, {{}, true});
  EXPECT_NEAR(*parameter_named(test.parameters, "undrained_strength_peak").value, 30, 1e-12);
  EXPECT_NEAR(*parameter_named(test.parameters, "undrained_strength_critical").value, 30, 1e-12);
  EXPECT_NEAR(*parameter_named(test.parameters, "pore_pressure_coefficient").value, 1.0, 1e-12);
  EXPECT_NEAR(*parameter_named(test.parameters, "secant_angle_peak").value, secant_angle({100, 40}), 1e-12);
}

TEST(OedometerTest, GivesBackK0AndItsModulus) {
  std::vector<ShearPoint> points{{10, 10, 0, 0}};
  for (int k = 1; k <= 40; ++k) {
    const double stress = 10 * std::pow(10, 0.05 * k);
    points.push_back({stress, 0.5 * stress, (stress - 10) / 5e3, (stress - 10) / 5e3});
  }
  points.push_back({200, 180, 0.19, 0.19});
  const OedometerTest test = evaluate_oedometer_test(points, {});
  ASSERT_TRUE(test.found());
  EXPECT_NEAR(*parameter_named(test.parameters, "K0").value, 0.5, 1e-12);
  EXPECT_TRUE(contains_truth(parameter_named(test.parameters, "K0"), 0.5));
  EXPECT_NEAR(test.modulus_range.second, 1000, 1e-9);
  EXPECT_NEAR(*parameter_named(test.parameters, "constrained_modulus").value, 5e3, 10);
  // For stresses between two rows the interpolation is exact.
  const OedometerTest decade = evaluate_oedometer_test(points, std::pair(100.0, 1000.0));
  EXPECT_NEAR(*parameter_named(decade.parameters, "constrained_modulus").value, 5e3, 1e-6);
  EXPECT_THAT(evaluate_oedometer_test(points, std::pair(100.0, 2000.0)).failure_reason,
              HasSubstr("from 10 to 1000, which does not contain the range 100 to 2000"));
  EXPECT_THAT(evaluate_oedometer_test({{10, 10, 0, 0}, {9, 9, 0, 0}}, {}).failure_reason,
              HasSubstr("does not grow"));
}

TEST(MeanAlongPath, HoldsTheTruthOfCorrelatedFluctuations) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 1000, kLength = 60;
  int held = 0, naive = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<double> values;
    double x = normal(random) / std::sqrt(1 - 0.25);
    for (int k = 0; k < kLength; ++k) values.push_back(3 + (x = 0.5 * x + normal(random)));
    held += contains_truth(mean_along_path("", values), 3);
    naive += contains_truth(mean_of_samples("", values), 3);
  }
  EXPECT_GE(held, 0.92 * kDraws);
  EXPECT_LE(held, 0.97 * kDraws);
  EXPECT_LT(naive, 0.85 * kDraws);
  EXPECT_FALSE(mean_along_path("", {1, 2, 3}).standard_error.has_value());
}

}  // namespace
}  // namespace floc
