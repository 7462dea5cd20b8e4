#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/contact/damping/viscous_damping.h"
#include "floc/contact/normal/linear_repulsion.h"

namespace floc {
namespace {

/// Returns the coefficient of restitution of a linear spring and dashpot with the damping ratio zeta: exp(-pi
/// zeta/sqrt(1 - zeta^2)).
double restitution_at(double zeta) {
  return std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta));
}

TEST(ViscousDamping, RatioInvertsTheRestitutionOfALinearOscillator) {
  for (const double e : {0.015, 0.2, 0.5, 0.99}) EXPECT_NEAR(restitution_at(damping_ratio(e)), e, 1e-14);
  EXPECT_EQ(damping_ratio(1.0), 0.0);
}

TEST(ViscousDamping, RatioIsThatOfItsRestitution) {
  // The published damping ratio is alpha_n = 0.248 for the coefficient of restitution e_n = sqrt(0.2), with
  // three digits.
  EXPECT_NEAR(damping_ratio(std::sqrt(0.2)), 0.248, 5e-4);
}

TEST(ViscousDamping, CoefficientIsTwiceTheRatioTimesTheCriticalRoot) {
  const double zeta = damping_ratio(0.3);
  const ViscousDamping effective{0.3, DampingMass::effective};
  EXPECT_DOUBLE_EQ(effective.coefficient(CollisionMass::between(3.0, 1.5), LinearRepulsion{7.0}),
                   2 * zeta * std::sqrt(1.0 * 7.0));
  const ViscousDamping grain{0.3, DampingMass::grain};
  EXPECT_DOUBLE_EQ(grain.coefficient(CollisionMass::between(3.0, 1.5), LinearRepulsion{7.0}),
                   2 * zeta * std::sqrt(2.0 * 7.0));
  EXPECT_DOUBLE_EQ(grain.coefficient(CollisionMass::between(3.0, 3.0), LinearRepulsion{7.0}),
                   2 * zeta * std::sqrt(3.0 * 7.0));
}

TEST(ViscousDamping, RestitutionOfAPairDependsNeitherOnSizesNorOnWhichGrainIsFirst) {
  for (const DampingMass rule : {DampingMass::effective, DampingMass::grain}) {
    const ViscousDamping damping{0.3, rule};
    const double ratio_among_equals =
        damping.coefficient(CollisionMass::between(1.0, 1.0), LinearRepulsion{7.0}) /
        (2 * std::sqrt(0.5 * 7.0));
    for (const double mass : {0.001, 0.25, 4.0}) {
      const double effective = mass / (1.0 + mass);
      EXPECT_EQ(damping.coefficient(CollisionMass::between(1.0, mass), LinearRepulsion{7.0}),
                damping.coefficient(CollisionMass::between(mass, 1.0), LinearRepulsion{7.0}));
      EXPECT_NEAR(damping.coefficient(CollisionMass::between(1.0, mass), LinearRepulsion{7.0}) /
                      (2 * std::sqrt(effective * 7.0)),
                  ratio_among_equals, 1e-15);
    }
  }
}

TEST(ViscousDamping, GrainMassRuleGivesTwoEqualSpheresTheSmallerRestitution) {
  const ViscousDamping grain{std::sqrt(0.2), DampingMass::grain};
  const double mass = 2.0, stiffness = 5.0;
  const double zeta_of_pair =
      grain.coefficient(CollisionMass::between(mass, mass), LinearRepulsion{stiffness}) /
      (2 * std::sqrt(mass / 2 * stiffness));
  // The expected value is the coefficient of restitution of the spheres in [SVI2024], given with three digits
  // (docs/physics.md, "Damping").
  EXPECT_NEAR(restitution_at(zeta_of_pair), 0.308, 5e-4);
}

}  // namespace
}  // namespace floc
