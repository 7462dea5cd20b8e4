#include "floc/fitting/simple_shear_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/base/random.h"
#include "support/coverage.h"

namespace floc::test {
namespace {

using testing::HasSubstr;

double tangent_of(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180.0);
}

const FittedParameter& of_planes(const SimpleShearTest& test, const std::string& name) {
  for (const FittedParameter& p : test.parameters)
    if (p.name == name) return p;
  throw std::runtime_error("no parameter " + name);
}

/// Returns a simple shear test under the normal stress 100. The friction angle rises to 35 degrees at a shear
/// strain of 0.05 and then falls to 25 degrees. The sample dilates with an angle of 10 degrees between the
/// strains 0.03 and 0.1.
/// @param sign  direction of the shear, 1 or -1
std::vector<PlaneShearPoint> planes_sheared(double sign) {
  std::vector<PlaneShearPoint> points;
  for (int k = 0; k <= 200; ++k) {
    PlaneShearPoint p;
    p.normal_stress = 100.0;
    p.shear_strain = sign * 0.002 * k;
    const double strain = 0.002 * k;
    const double rise = tangent_of(35.0) * (1.0 - std::pow(1.0 - std::min(strain / 0.05, 1.0), 2));
    const double softened =
        tangent_of(25.0) + (tangent_of(35.0) - tangent_of(25.0)) * std::exp(-(strain - 0.05) / 0.02);
    p.shear_stress = sign * 100.0 * (strain < 0.05 ? rise : softened);
    p.volumetric_strain = -tangent_of(10.0) * std::clamp(strain - 0.03, 0.0, 0.07);
    points.push_back(p);
  }
  return points;
}

TEST(SimpleShear, GivesBackItsAnglesInBothDirections) {
  for (const double sign : {1.0, -1.0}) {
    const SimpleShearTest test = evaluate_simple_shear_test(planes_sheared(sign), {});
    ASSERT_TRUE(test.found()) << test.failure_reason;
    EXPECT_NEAR(*of_planes(test, "secant_angle_peak").value, 35.0, 1e-9);
    EXPECT_NEAR(*of_planes(test, "strain_peak").value, 0.05, 1e-12);
    EXPECT_NEAR(*of_planes(test, "dilatancy_angle").value, 10.0, 1e-6);
    EXPECT_NEAR(*of_planes(test, "secant_angle_critical").value, 25.0, 1e-3);
    EXPECT_NEAR(test.peak_stress.shear, 100.0 * tangent_of(35.0), 1e-9);
  }
}

TEST(SimpleShear, ThatStillDilatesHasNoCriticalState) {
  std::vector<PlaneShearPoint> points = planes_sheared(1.0);
  points.resize(50);
  const SimpleShearTest test = evaluate_simple_shear_test(points, {});
  EXPECT_FALSE(test.critical_stress.has_value());
  EXPECT_THAT(test.warnings, testing::ElementsAre(HasSubstr("has not reached a critical state")));
  EXPECT_THAT(evaluate_simple_shear_test({{}, {}}, {}).failure_reason, HasSubstr("it has 2 states"));
}

TEST(SimpleShear, TestsTogetherHaveALineWhoseIntervalsHoldTheTruth) {
  constexpr int kDraws = 1000;
  RandomStream random(6, 0);
  Coverage coverage({{"friction_angle_peak", 31.0}, {"cohesion_peak", 12.0}});
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<PlaneStress> stresses;
    for (const double normal : {25.0, 50.0, 100.0, 200.0, 400.0})
      stresses.push_back({normal, (12.0 + normal * tangent_of(31.0)) * (1.0 + 0.03 * random.normal())});
    const MohrCoulombFit fit = fit_mohr_coulomb_planes(stresses, "_peak");
    coverage.add(fit.angle);
    coverage.add(fit.cohesion);
  }
  coverage.expect_honest(kDraws, "line of simple shear");
  EXPECT_THAT(fit_mohr_coulomb_planes({{100, 60}, {200, 120}}, "").failure_reason,
              HasSubstr("there are 2 tests"));
  EXPECT_THAT(fit_mohr_coulomb_planes({{100, 60}, {200, 50}, {300, 40}}, "").failure_reason,
              HasSubstr("no friction angle"));
}

}  // namespace
}  // namespace floc::test
