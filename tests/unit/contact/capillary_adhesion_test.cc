#include "floc/contact/adhesion/capillary_adhesion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "floc/base/dual.h"
#include "floc/contact/law_table.h"

namespace floc {
namespace {

using Law = ContactLaw<LinearRepulsion, CapillaryAdhesion, NoDamping, NoFriction, NoRolling, NoTwisting>;

/// Water between clean grains.
constexpr CapillaryAdhesion kWater{0.072, 0.0, 0.007, 2.6};
constexpr double kVolume = 1e-11;  // volume of a bridge between grains of a millimetre (m^3)
constexpr double kDigits = 2e-10;  // relative error of reference values with ten digits

CapillaryAdhesion rational() {
  CapillaryAdhesion law = kWater;
  law.form = BridgeForm::rational;
  return law;
}

void expect_relative(double value, double expected, double tolerance = kDigits) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

/// Reference values of a bridge: the strength, the decay length l, the rupture distance hm, the force at a gap of l/2,
/// exp(-hm/l), and minus the energy at a gap of zero.
struct Expected {
  double strength, decay_length, reach, half_way, at_reach, energy;
};

void expect_bridge(double radius_i, double radius_j, const Expected& expected) {
  const Bridge<> b = kWater.bridge(radius_i, radius_j, kVolume);
  expect_relative(b.strength, expected.strength);
  expect_relative(1.0 / b.decay, expected.decay_length);
  expect_relative(b.reach, expected.reach);
  expect_relative(kWater.force(PairGeometry<>(0.5 / b.decay), b), expected.half_way);
  EXPECT_NEAR(std::exp(-b.reach * b.decay), expected.at_reach, 5e-7);
  expect_relative(-kWater.energy(PairGeometry<>(0.0), b), expected.energy);
}

TEST(CapillaryAdhesion, HasTheNumbersOfTwoPairsOfGrainsOfAMillimetre) {
  expect_bridge(1e-3, 1e-3, {4.523893421e-4, 9e-5, 2.154434690e-4, -2.743880061e-4, 0.091281, 3.699854492e-8});
  expect_bridge(0.5e-3, 1e-3,
                {3.198875715e-4, 7.794228634e-5, 2.154434690e-4, -1.940216198e-4, 0.063030, 2.336125082e-8});
}

TEST(CapillaryAdhesion, DecayLengthHasTwoForms) {
  for (const double radius_j : {1e-3, 0.6e-3, 0.1e-3}) {
    const double radius_i = 1e-3, ratio = std::max(radius_i / radius_j, radius_j / radius_i);
    const double other =
        0.9 / std::numbers::sqrt2 * std::sqrt((1.0 / radius_i + 1.0 / radius_j) * kVolume / ratio);
    expect_relative(1.0 / kWater.bridge(radius_i, radius_j, kVolume).decay, other, 1e-15);
    EXPECT_EQ(kWater.bridge(radius_i, radius_j, kVolume).decay,
              kWater.bridge(radius_j, radius_i, kVolume).decay);
  }
}

TEST(CapillaryAdhesion, RationalFormIsTheOneOfTheExactBridgesToWithinItsError) {
  const CapillaryAdhesion law = rational();
  const Bridge<> b = law.bridge(1e-3, 1e-3, kVolume);
  for (const double x : {0.0, 0.3, 1.0, 2.0})
    expect_relative(law.force(PairGeometry<>(x / b.decay), b), -b.strength / (1.0 + 1.05 * x + 2.5 * x * x),
                    1e-15);
  // Exact forces of bridges with the volume 1e-3 R^3, from the Young-Laplace equation, at several ratios h/l of
  // the gap to the decay length.
  const double l = 1.0 / kWater.bridge(1e-3, 1e-3, 1e-12).decay;
  const Bridge<> small = law.bridge(1e-3, 1e-3, 1e-12);
  for (const auto& [gap, exact] : {std::pair{0.1, 0.841}, {0.5, 0.508}, {1.0, 0.270}})
    expect_relative(law.force(PairGeometry<>(gap * l), small), -small.strength * exact, 0.07);
}

TEST(CapillaryAdhesion, ReachesFurtherAtAWiderContactAngleAndPullsLess) {
  CapillaryAdhesion law = kWater;
  law.contact_angle = 60.0;
  expect_relative(law.strength(1e-3, 1e-3), 0.5 * kWater.strength(1e-3, 1e-3), 1e-15);
  expect_relative(law.reach(kVolume), (1.0 + std::numbers::pi / 6.0) * std::cbrt(kVolume), 1e-15);
}

TEST(CapillaryAdhesion, ForceIsMinusTheSlopeOfTheEnergyAndStiffnessThatOfTheForce) {
  for (const CapillaryAdhesion& law : {kWater, rational()}) {
    const Bridge<> b = law.bridge(0.7e-3, 1e-3, kVolume);
    const Bridge<Dual<1>> dual{b.strength, b.decay, b.reach};
    for (const double share : {-0.1, 0.01, 0.3, 0.7, 0.99, 1.01}) {
      SCOPED_TRACE(share);
      const PairGeometry<Dual<1>> pair(Dual<1>(share * b.reach, 0));
      const double gap = share * b.reach;
      EXPECT_NEAR(-law.energy(pair, dual).derivative[0], law.force(PairGeometry<>(gap), b), 1e-13 * b.strength);
      EXPECT_NEAR(-law.force(pair, dual).derivative[0], law.stiffness(PairGeometry<>(gap), b),
                  1e-13 * b.strength * b.decay);
    }
  }
}

TEST(CapillaryAdhesion, ForceIsContinuousInContactAndJumpsAtTheReachWhereTheEnergyDoesNot) {
  for (const CapillaryAdhesion& law : {kWater, rational()}) {
    const Bridge<> b = law.bridge(1e-3, 1e-3, kVolume);
    EXPECT_EQ(law.force(PairGeometry<>(-1e-30), b), -b.strength);
    EXPECT_EQ(law.force(PairGeometry<>(0.0), b), -b.strength);
    EXPECT_LT(law.force(PairGeometry<>(b.reach), b), -0.05 * b.strength);
    EXPECT_EQ(law.force(PairGeometry<>(std::nextafter(b.reach, 1.0)), b), 0.0);
    EXPECT_EQ(law.energy(PairGeometry<>(b.reach), b), 0.0);
    EXPECT_EQ(law.energy(PairGeometry<>(2.0 * b.reach), b), 0.0);
    EXPECT_EQ(law.stiffness(PairGeometry<>(2.0 * b.reach), b), 0.0);
  }
}

TEST(CapillaryAdhesion, WithoutAVolumeThereIsNothing) {
  const Bridge<> b = kWater.bridge(1e-3, 1e-3, 0.0);
  for (const double gap : {-1e-6, 0.0, 1e-9, 1e-3}) {
    EXPECT_EQ(kWater.force(PairGeometry<>(gap), b), 0.0);
    EXPECT_EQ(kWater.stiffness(PairGeometry<>(gap), b), 0.0);
    EXPECT_EQ(kWater.energy(PairGeometry<>(gap), b), 0.0);
  }
}

/// Two spheres of a millimetre that are moved quasi-statically.
struct Doublet {
  Law law;
  PackedHistory<1> history;

  explicit Doublet(BridgeFormation formation, double volume = kVolume)
      : law{LinearRepulsion{1e3}, kWater, {}, {}, {}, {}} {
    law.adhesion.formation = formation;
    history.value[0] = volume;
  }
  double force(double gap) {
    const ContactMotion<3> motion{gap, 0.0, 0.0, Shear<3>::Zero(), RotationVector<3>::Zero()};
    return law.respond<3, double>(motion, history, law.pair_parameters<3>(1e-3, 1e-3, history)).normal.force();
  }
  /// Returns the work that the normal force does on the grains while their gap changes from `from` to `to`, integrated
  /// by the trapezoidal rule.
  double work(double from, double to) {
    constexpr int n = 200000;
    double sum = 0.0, before = force(from);
    for (int k = 1; k <= n; ++k) {
      const double now = force(from + (to - from) * k / n);
      sum += 0.5 * (before + now) * (to - from) / n;
      before = now;
    }
    return sum;
  }
  Bridge<> bridge() const { return law.pair_parameters<3>(1e-3, 1e-3, history); }
};

TEST(Doublet, RestsPullsOffAndPartsAsTheClosedFormsSay) {
  Doublet pair(BridgeFormation::gap);
  const Bridge<> b = pair.bridge();
  const double h0 = b.strength / 1e3;
  EXPECT_NEAR(pair.force(-h0), 0.0, 1e-15 * b.strength);
  EXPECT_EQ(pair.force(0.0), -b.strength);
  const double separation =
      b.strength * b.strength / 2e3 + b.strength / b.decay * (1.0 - std::exp(-b.reach * b.decay));
  expect_relative(pair.law.energy<double>(PairGeometry<>(2.0 * b.reach), nullptr, b) -
                      pair.law.energy<double>(PairGeometry<>(-h0), nullptr, b),
                  separation, 1e-14);
  // At the rupture distance, the force jumps to zero. The error comes from the integration step that contains this
  // jump.
  expect_relative(-pair.work(-h0, 1.1 * b.reach), separation, 2e-5);
}

TEST(Doublet, GivesBackInApproachWhatPartingTookWhereBridgesFormAcrossTheGap) {
  Doublet pair(BridgeFormation::gap);
  const double far = 1.1 * pair.bridge().reach, near = -1e-6;
  const double in = pair.work(far, near), out = pair.work(near, far);
  EXPECT_NEAR(in + out, 0.0, 1e-12 * std::abs(in));
  EXPECT_EQ(pair.history.value[0], kVolume);
}

TEST(Doublet, LosesTheEnergyOfTheBridgeWhereItFormsOnContact) {
  Doublet pair(BridgeFormation::contact, -kVolume);  // a negative volume marks a broken bridge
  const Bridge<> b = pair.bridge();
  const double far = 1.1 * b.reach, near = -1e-6;
  const double in = pair.work(far, near);
  EXPECT_EQ(pair.history.value[0], kVolume);
  const double out = pair.work(near, far);
  EXPECT_EQ(pair.history.value[0], -kVolume);
  expect_relative(-(in + out), b.strength / b.decay * (1.0 - std::exp(-b.reach * b.decay)), 5e-5);
}

TEST(Doublet, ABridgeThatFormedOnContactLivesUntilItsReach) {
  Doublet pair(BridgeFormation::contact, -kVolume);
  const double reach = pair.bridge().reach;
  EXPECT_EQ(pair.force(0.5 * reach), 0.0);
  EXPECT_LT(pair.force(-1e-12), 0.0);
  EXPECT_LT(pair.force(0.9 * reach), 0.0);
  EXPECT_LT(pair.force(0.5 * reach), 0.0);
  EXPECT_EQ(pair.force(1.01 * reach), 0.0);
  EXPECT_EQ(pair.force(0.5 * reach), 0.0);
}

std::string faults_of(const LawParameters& law) {
  std::string all;
  for (const std::string& fault : law.validate()) all += fault + "\n";
  return all;
}

TEST(CapillaryAdhesion, RefusesNumbersThatNoLiquidHas) {
  LawParameters law;
  law.normal = LinearRepulsion{1e5};
  law.adhesion = kWater;
  EXPECT_EQ(faults_of(law), "");
  law.adhesion = CapillaryAdhesion{0.0, 0.0, 0.01, 2.6};
  EXPECT_EQ(faults_of(law), "contact.adhesion.surface_tension = 0: must be positive and finite\n");
  law.adhesion = CapillaryAdhesion{0.072, 90.5, 0.01, 2.6};
  EXPECT_EQ(faults_of(law), "contact.adhesion.contact_angle = 90.5: must be in [0, 90] degrees\n");
  law.adhesion = CapillaryAdhesion{0.072, -1.0, -0.01, 0.0};
  EXPECT_EQ(faults_of(law),
            "contact.adhesion.contact_angle = -1: must be in [0, 90] degrees\n"
            "contact.adhesion.water_content = -0.01: must be >= 0 and finite\n"
            "contact.adhesion.density_ratio = 0: must be positive and finite\n");
  law.adhesion = kWater;
  law.friction = CoulombFriction{0.5, 1e5};
  law.rolling = RollingSpring{0.01, 10.0};
  EXPECT_NE(faults_of(law).find("contact.rolling is not allowed here: grains with contact.adhesion.law = "
                                "\"capillary\" roll and twist without resistance; leave out this table"),
            std::string::npos);
}

TEST(ExpOfNegative, IsRightToTwoUnitsInTheLastPlace) {
  for (double x = -689.0; x < 0.0; x += 0.00713)
    ASSERT_NEAR(lanes::exp_of_negative(x) / std::exp(x), 1.0, 4.5e-16) << x;
  EXPECT_EQ(lanes::exp_of_negative(0.0), 1.0);
  EXPECT_EQ(lanes::exp_of_negative(-1e300), lanes::exp_of_negative(-690.0));
}

}  // namespace
}  // namespace floc
