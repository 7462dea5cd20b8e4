#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "floc/fitting/consolidation.h"
#include "floc/fitting/dynamic_compaction.h"
#include "floc/fitting/elastic_line.h"
#include "floc/fitting/preconsolidation.h"
#include "floc/fitting/scattering_fit.h"

namespace floc {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

TEST(PhysicalRange, CutsIntervalsAndTakesBackValuesBeyond) {
  FittedParameter inside{"x", 0.9, 0.1, 0.7, 1.1, true};
  EXPECT_EQ(keep_in_range({0.0, 1.0}, inside), "");
  EXPECT_TRUE(inside.identified);
  EXPECT_EQ(inside.low95, 0.7);
  EXPECT_EQ(inside.high95, 1.0);
  for (const double beyond : {-0.1, 1.1, 2.0}) {
    FittedParameter p{"x", beyond, 0.1, beyond - 0.2, beyond + 0.2, true};
    EXPECT_THAT(keep_in_range({0.0, 1.0}, p), testing::HasSubstr("x is not identified by these data"));
    EXPECT_FALSE(p.value || p.standard_error || p.identified);
    EXPECT_EQ(p.low95, 0.0);
    EXPECT_EQ(p.high95, 1.0);
  }
  FittedParameter positive{"x", -3.0, 1.0, -5.0, -1.0, true};
  EXPECT_THAT(keep_in_range({0.0, kAny}, positive), testing::HasSubstr("at least 0"));
  EXPECT_FALSE(positive.high95);
  FittedParameter none{"x", std::nullopt, std::nullopt, std::nullopt, std::nullopt, false};
  EXPECT_EQ(keep_in_range({0.0, 1.0}, none), "");
}

/// A fit in which one parameter would leave its physical range.
struct Beyond {
  const char* parameter;
  double low, high;  ///< physical range of the parameter
  std::vector<FittedParameter> parameters;
  std::vector<std::string> warnings;
};

/// Data of Heckel's law, ln[1/(1 - D)] = 0.55 + p/85 [Heckel 1961]. If the full law is fitted, the best value of its
/// limit Phi_max is above one.
Beyond heckel() {
  ConsolidationCurve curve;
  for (double p = 10.0; p < 425.0; p += 10.0) {
    curve.P_star.push_back(p);
    curve.phi.push_back(1.0 - std::exp(-0.55 - p / 85.0));
  }
  const ConsolidationFit fit = fit_consolidation(curve, {});
  EXPECT_TRUE(fit.found()) << fit.failure_reason;
  return {"Phi_max", 0.0, 1.0, fit.parameters, fit.warnings};
}

/// Data of a power law with the limit Phi_max = 1.05, at pressures where Phi is below one.
Beyond power_law() {
  ConsolidationCurve curve;
  for (double p = 1.0; p < 14.0; p *= 1.1) {
    curve.P_star.push_back(p);
    curve.phi.push_back(1.0 / (1.0 / 1.05 + 0.7 / p));
  }
  ConsolidationOptions options;
  options.law = ConsolidationLaw::power;
  options.window = {1.0, 14.0};
  const ConsolidationFit fit = fit_consolidation(curve, options);
  EXPECT_TRUE(fit.found()) << fit.failure_reason;
  return {"Phi_max", 0.0, 1.0, fit.parameters, fit.warnings};
}

/// Data of a reloading branch along which the sample expands before it yields.
Beyond dilating() {
  std::vector<double> P, phi;
  for (double p = 0.1; p < 20.0; p *= 1.3) {
    const double x = std::log(p / 1.7);
    P.push_back(p);
    phi.push_back(1.0 / (1.6 + (x < 0.0 ? 0.02 : -0.2) * x));
  }
  const PreconsolidationFit fit = fit_preconsolidation(P, phi);
  return {"kappa", 0.0, kAny, fit.parameters, fit.warnings};
}

/// Samples that follow the law of the published series [SVI2024], but with other values of e_min and C. Samples with a
/// negative void ratio are left out.
Beyond compacted(const char* parameter, double e_min, double C) {
  std::vector<CompactedSample> samples;
  for (const double p : {0.01, 0.1, 0.5, 1.0})
    for (const double se : {500.0, 2e3, 1e4, 5e4, 2e5})
      for (const double eta : {1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.05, 0.1, 0.2, 0.5, 2.0, 15.0}) {
        const double sc = eta * std::sqrt(p * se);
        const double e_max = e_min + 1.0 / (1.0 + C * std::log(p / 0.01));
        const double x = eta / 0.045;
        const double right = 1.0 / (0.475 * std::pow(x, 0.74) + (1 / 1.55 - 0.475) * std::pow(x, 2.3));
        const double e = e_min + (e_max - e_min) / (1.0 + right);
        if (sc <= 0.1 * se && e > 0.0) samples.push_back({e, p, sc, se});
      }
  const CompactionFit fit = fit_dynamic_compaction(samples, {});
  EXPECT_TRUE(fit.found()) << fit.failure_reason;
  return {parameter, 0.0, kAny, fit.parameters, fit.warnings};
}

/// Data of an intensity that decreases with k faster than the scattering by any surface.
Beyond scattered(double dF) {
  std::vector<ScatteredPoint> points;
  for (double k = 0.1; k < 4.0; k *= 1.1) points.push_back({k, scattered_intensity(1.0, 9.0, dF, k), 1000000});
  const ScatteringFit fit = fit_scattering(points, 0.0, 4.0);
  return {"dF", 0.0, 4.0, fit.parameters, fit.warnings};
}

/// In each of these fits, the best value of one parameter is outside of its physical range. The fit must give no value
/// for this parameter. All values that it gives must be within their ranges.
TEST(PhysicalRange, HoldsForEveryFit) {
  const std::vector<Beyond> fits = {
      heckel(),      power_law(), dilating(), compacted("e_min", -0.15, 0.24), compacted("C", 0.76, -0.05),
      scattered(6.0)};
  int n_parameters = 0;
  for (const Beyond& fit : fits) {
    bool found = false;
    for (const FittedParameter& p : fit.parameters) {
      ++n_parameters;
      if (p.value) {
        EXPECT_GE(*p.value, 0.0) << p.name;
      }
      if (p.name != fit.parameter) continue;
      found = true;
      EXPECT_FALSE(p.value) << p.name << " = " << *p.value;
      EXPECT_FALSE(p.identified) << p.name;
      if (p.low95) {
        EXPECT_GE(*p.low95, fit.low) << p.name;
      }
      if (p.high95) {
        EXPECT_LE(*p.high95, fit.high) << p.name;
      }
    }
    EXPECT_TRUE(found) << fit.parameter;
    EXPECT_THAT(fit.warnings, testing::Contains(testing::HasSubstr(fit.parameter))) << fit.parameter;
  }
  fmt::print("{} fits beyond physics, {} parameters looked at\n", fits.size(), n_parameters);
}

TEST(PhysicalRange, LeavesTheLimitOfHeckelBetweenTheDataAndOne) {
  for (const FittedParameter& p : heckel().parameters) {
    if (p.name != "Phi_max") continue;
    EXPECT_GT(p.low95.value_or(0.0), 0.9);
    EXPECT_EQ(p.high95, 1.0);
  }
}

}  // namespace
}  // namespace floc
