#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/laws.h"

namespace floc {
namespace {

using test::at_gap;
using test::for_each_kind_of_law;
using test::for_each_kind_of_law_and_dimension;
using test::pair_at;
using test::pull_off_force;
using test::stiffness_at;

/// Returns the largest gap at which surfaces that have touched before still stick together under the law.
double holding_range(const auto& law) {
  return law.holding_range(pair_at(0.0).reduced_radius);
}

/// Returns gaps at which surfaces overlap, attract each other, or do not interact. The kinks of the force, at 0 and at
/// the end of the attractive range, are not among the gaps.
std::vector<double> gaps(const auto& law) {
  const double range = std::max(law.range(), holding_range(law));
  return {
      -3e-4, -1.25e-5, -1e-6, 0.01 * range + 1e-9, 0.5 * range + 1e-9, 0.97 * range + 1e-9, 1.5 * range + 1e-6};
}

/// Returns the normal force of a contact that has been pressed before. The history of the contact is not updated.
double static_force(const auto& law, double gap) {
  return test::pressed_response(law, gap).force();
}

/// Returns the normal force between surfaces that have not touched before.
double new_force(const auto& law, double gap) {
  return law.normal(pair_at(gap)).force();
}

TEST(NormalForce, IsMinusTheSlopeOfTheEnergy) {
  for_each_kind_of_law([](const auto& law) {
    for (const double h : gaps(law)) {
      SCOPED_TRACE(h);
      const double slope = test::pressed_energy(law, ceres::Jet<double, 1>(h, 0)).v[0];
      // The derivative is exact, so the two numbers differ only by rounding.
      EXPECT_NEAR(static_force(law, h), -slope, 1e-14 * (std::abs(slope) + 1.0));
    }
  });
}

TEST(NormalForce, IsMinusTheDifferenceQuotientOfTheEnergy) {
  for_each_kind_of_law([](const auto& law) {
    for (const double h : gaps(law)) {
      SCOPED_TRACE(h);
      const double step = 1e-10;
      const double quotient =
          (test::pressed_energy(law, h + step) - test::pressed_energy(law, h - step)) / (2 * step);
      // The truncation error is at most 1e-7. Energies are of the order of 1e-2. Their rounding errors of about 1e-18
      // are divided by the step.
      EXPECT_NEAR(static_force(law, h), -quotient, 1e-18 / step * 10 + 1e-7);
    }
  });
}

TEST(NormalStiffness, IsMinusTheSlopeOfTheForce) {
  for_each_kind_of_law([](const auto& law) {
    for (const double h : gaps(law)) {
      SCOPED_TRACE(h);
      const double slope = test::pressed_response(law, ceres::Jet<double, 1>(h, 0)).force().v[0];
      EXPECT_DOUBLE_EQ(test::pressed_response(law, h).stiffness, -slope);
      EXPECT_DOUBLE_EQ(test::pressed_response(law, h).elastic_stiffness, -slope);
      EXPECT_DOUBLE_EQ(test::pressed_stiffness(law, h).normal, -slope);
    }
  });
}

TEST(NormalStiffness, IsMinusTheDifferenceQuotientOfTheForce) {
  for_each_kind_of_law([](const auto& law) {
    for (const double h : gaps(law)) {
      SCOPED_TRACE(h);
      const double step = 1e-10;
      const double quotient = (static_force(law, h + step) - static_force(law, h - step)) / (2 * step);
      // Forces are at most 30, with a rounding error of 4e-15. Divided by the step, this gives an error of
      // 2e-5; stiffnesses are at least 1e3.
      EXPECT_NEAR(test::pressed_stiffness(law, h).normal, -quotient, 1e-4);
    }
  });
}

TEST(NormalForce, IsTheOneThatRespondReports) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    for (const double h : gaps(law)) {
      SCOPED_TRACE(h);
      test::ContactHistoryOf<Law, Dim> history;
      ContactMotion<Dim> motion = at_gap<Dim>(h);
      motion.gap_rate = 0.7;
      motion.damping = law.damping_coefficient(CollisionMass::between(1.0, 0.5));
      const auto forces = law.respond(motion, history);
      EXPECT_EQ(forces.normal.elastic, law.normal(pair_at(h)).elastic);
      EXPECT_EQ(forces.normal.adhesive, law.normal(pair_at(h)).adhesive);
      EXPECT_EQ(forces.normal.stiffness, law.normal(pair_at(h)).stiffness);
    }
  });
}

TEST(NormalForce, ElasticPartRepelsAndAdhesivePartAttracts) {
  for_each_kind_of_law([](const auto& law) {
    for (const double h : gaps(law)) {
      SCOPED_TRACE(h);
      EXPECT_GE(law.normal(pair_at(h)).elastic, 0.0);
      EXPECT_LE(law.normal(pair_at(h)).adhesive, 0.0);
      if (h > 0) {
        EXPECT_EQ(law.normal(pair_at(h)).elastic, 0.0);
      }
    }
  });
}

TEST(NormalForce, EnergyAndForceVanishFromTheRangeOn) {
  for_each_kind_of_law([](const auto& law) {
    const double range = std::max(law.range(), holding_range(law));
    for (const double h : {range, std::nextafter(range, 1.0), 2 * range, 1.0}) {
      SCOPED_TRACE(h);
      EXPECT_EQ(static_force(law, h), 0.0);
      EXPECT_EQ(test::pressed_energy(law, h), 0.0);
      EXPECT_EQ(test::pressed_stiffness(law, h).normal, 0.0);
    }
  });
}

TEST(NormalForce, EnergyHasNoJumpWhereSurfacesPartOrTheTailEnds) {
  for_each_kind_of_law([](const auto& law) {
    const double step = 1e-12;
    for (const double kink : {0.0, law.range(), holding_range(law)}) {
      SCOPED_TRACE(kink);
      // Within the step on either side of the kink, the magnitude of the force is at most F0 + K_N times the step. The
      // change of the energy is below the bound that follows.
      EXPECT_NEAR(test::pressed_energy(law, kink + step), test::pressed_energy(law, kink - step),
                  2 * step * (pull_off_force(law) + 1e-6));
    }
  });
}

TEST(PullOff, LargestTensionIsF0AndIsReachedInContact) {
  for_each_kind_of_law([](const auto& law) {
    double largest = 0.0;
    const double end = std::max(law.range(), holding_range(law)) + 1e-4;
    for (int k = 1; k < 4000; ++k)
      largest = std::max(largest, -static_force(law, -1e-4 + k * (end + 1e-4) / 4000));
    EXPECT_LE(largest, pull_off_force(law));
    // Just before the surfaces separate, the elastic force is smaller than the rounding error of F0.
    if (holding_range(law) > 0.0)
      EXPECT_NEAR(-static_force(law, std::nextafter(holding_range(law), 0.0)), pull_off_force(law), 1e-15);
    else
      EXPECT_NEAR(-static_force(law, -1e-25), pull_off_force(law), 1e-19);
  });
}

TEST(PullOff, EquilibriumIsAtOverlapF0OverKN) {
  for_each_kind_of_law([](const auto& law) {
    const double h0 = test::free_overlap(law);
    // At the overlap h0, K_N h0 equals F0; their difference has the rounding error of F0.
    EXPECT_NEAR(new_force(law, -h0), 0.0, 4e-16 * pull_off_force(law));
    if (h0 > 0) {
      EXPECT_GT(new_force(law, -1.01 * h0), 0.0);
      EXPECT_LT(new_force(law, -0.99 * h0), 0.0);
    }
  });
}

TEST(PullOff, SeparationEnergyIsThatOfTheWellAndTheTail) {
  for_each_kind_of_law([](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    if constexpr (std::is_same_v<typename Law::NormalModel, LinearRepulsion>) {
      const double f0 = pull_off_force(law);
      const double kn = law.repulsion.normal_stiffness;
      const double expected = f0 * f0 / (2 * kn) + f0 * law.range() / 2;
      EXPECT_NEAR(-law.energy(pair_at(-f0 / kn)), expected, 1e-15 * (expected + f0 * f0 / kn));
    }
  });
}

TEST(Tail, ActsOnApproachAsOnParting) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    if constexpr (!test::kForgetsOverlap<decltype(law)>) return;
    test::ContactHistoryOf<decltype(law), Dim> history;
    std::vector<double> approaching, parting;
    const int n = 50;
    const auto gap = [&](int k) { return (law.range() + 1e-4) * (1.0 - 2.0 * k / n); };
    for (int k = 0; k <= n; ++k)
      approaching.push_back(law.respond(at_gap<Dim>(gap(k)), history).normal.force());
    for (int k = n; k >= 0; --k) parting.push_back(law.respond(at_gap<Dim>(gap(k)), history).normal.force());
    EXPECT_EQ(approaching, std::vector<double>(parting.rbegin(), parting.rend()));
  });
}

TEST(Tail, CarriesNothingButTheNormalAttraction) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    for (const double h : {0.0, 0.5 * law.range(), 0.99 * law.range(), 2 * law.range()}) {
      SCOPED_TRACE(h);
      test::ContactHistoryOf<decltype(law), Dim> history;
      ContactMotion<Dim> motion = at_gap<Dim>(h);
      motion.slip = test::slip_by<Dim>(1e-3);
      motion.relative_rotation.setConstant(0.01);
      motion.gap_rate = -1.0;
      motion.damping = law.damping_coefficient(CollisionMass::between(1.0, 1.0));
      const auto forces = law.respond(motion, history);
      EXPECT_EQ(forces.viscous, 0.0);
      EXPECT_EQ(forces.shear.norm(), 0.0);
      EXPECT_EQ(forces.rolling.norm(), 0.0);
      EXPECT_EQ(stiffness_at(law, h).tangential, 0.0);
      EXPECT_EQ(stiffness_at(law, h).rolling, 0.0);
    }
  });
}

}  // namespace
}  // namespace floc
