#include "floc/rigid/static_forces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "floc/base/error.h"
#include "floc/packing/balance.h"
#include "floc/packing/locate.h"
#include "floc/rigid/near_contacts.h"
#include "support/crystals.h"
#include "support/few_grains.h"
#include "support/network_packings.h"

namespace floc::test {
namespace {

using testing::HasSubstr;

constexpr double kFriction = 0.3;

Law frictional_law(double friction = kFriction) {
  Law law;
  law += linear(1e4);
  law += coulomb(friction, 5e3);
  return law;
}

/// Returns a crystal of slightly displaced grains of diameter 1 at distances of about 0.98. Its contacts have
/// no forces yet.
template <int Dim>
Packing<Dim> packing_without_forces(unsigned seed, double friction = kFriction) {
  constexpr double kDistance = 0.98, kDisplacement = 0.005;
  std::vector<Vec<Dim>> places;
  Vec<Dim> side;
  if constexpr (Dim == 2) {
    side = {4.0, 2.0 * std::sqrt(3.0)};
    for (int row = 0; row < 4; ++row)
      for (int k = 0; k < 4; ++k) places.emplace_back(k + 0.5 * (row % 2), row * std::sqrt(0.75));
  } else {
    side.setConstant(2.0 * std::sqrt(2.0));
    for (int cell = 0; cell < 8; ++cell)
      for (const Vec<3>& place : face_centred_cubic().places)
        places.push_back(std::sqrt(2.0) * (Vec<3>(cell & 1, cell >> 1 & 1, cell >> 2) + place));
  }
  Packing<Dim> packing = unit_grains<Dim>(places, 1.0, frictional_law(friction));
  packing.cell.matrix = (kDistance * side).asDiagonal();
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-kDisplacement, kDisplacement);
  for (Vec<Dim>& x : packing.grains.position)
    x = kDistance * x + Vec<Dim>::NullaryExpr([&] { return uniform(engine); });
  find_contacts(packing);
  for (Contact<Dim>& c : packing.contacts) c.normal_force = c.elastic_force = 0.0;
  set_arms(packing);
  return packing;
}

template <int Dim>
void give_forces(const BalancedForces<Dim>& forces, Packing<Dim>& packing) {
  for (std::size_t k = 0; k < packing.contacts.size(); ++k) {
    packing.contacts[k].normal_force = packing.contacts[k].elastic_force = forces.normal_force[k];
    packing.contacts[k].shear_force = forces.shear_force[k];
  }
}

template <int Dim>
ForceBalanceOptions<Dim> under_pressure(double pressure) {
  ForceBalanceOptions<Dim> options;
  options.stress = pressure * Mat<Dim>::Identity();
  return options;
}

template <class Dimension>
class StaticForcesOf : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(StaticForcesOf, Dimensions);

TYPED_TEST(StaticForcesOf, CanonicalForcesBalanceGrainsAndStress) {
  constexpr int Dim = TypeParam::value;
  Packing<Dim> packing = packing_without_forces<Dim>(1);
  const BalancedForces<Dim> forces = StaticForces<Dim>("s.h5", packing, under_pressure<Dim>(2.0)).canonical();
  give_forces(forces, packing);
  // net_forces() computes the balance independently of the constraints of the cone program.
  const Balance<Dim> balance = net_forces(packing);
  for (int i = 0; i < packing.grains.size(); ++i) {
    EXPECT_LT(balance.force[i].norm(), 1e-9);
    EXPECT_LT(balance.moment[i].norm(), 1e-9);
  }
  EXPECT_LT((static_stress(packing) - 2.0 * Mat<Dim>::Identity()).norm(), 1e-9);
  for (const Contact<Dim>& c : packing.contacts) {
    EXPECT_GE(c.normal_force, 0.0);
    EXPECT_LE(c.shear_force.norm(), kFriction * c.normal_force + 1e-12);
    EXPECT_NEAR(c.shear_force.dot(c.normal), 0.0, 1e-12);
  }
}

TYPED_TEST(StaticForcesOf, CanonicalForcesComeBackFromTheirGeometry) {
  constexpr int Dim = TypeParam::value;
  Packing<Dim> packing = packing_without_forces<Dim>(2);
  const BalancedForces<Dim> forces = StaticForces<Dim>("s.h5", packing, under_pressure<Dim>(2.0)).canonical();
  give_forces(forces, packing);
  StaticForces<Dim> again("s.h5", packing, {});
  EXPECT_LT(force_distance(forces, again.canonical()), 1e-12);
  EXPECT_LT(force_distance(forces, again.closest()), 1e-12);
}

TYPED_TEST(StaticForcesOf, ClosestForcesToBalancedOnesAreThose) {
  constexpr int Dim = TypeParam::value;
  Packing<Dim> packing = packing_without_forces<Dim>(3);
  // The forces balance, but they have the least energy for other stiffnesses, not for the default stiffnesses.
  ForceBalanceOptions<Dim> options = under_pressure<Dim>(1.0);
  options.kn = 1.0;
  options.kt = 50.0;
  const BalancedForces<Dim> forces = StaticForces<Dim>("s.h5", packing, options).canonical();
  give_forces(forces, packing);
  StaticForces<Dim> again("s.h5", packing, {});
  EXPECT_LT(force_distance(forces, again.closest()), 1e-12);
  EXPECT_GT(force_distance(forces, again.canonical()), 1e-3);
}

/// Returns the sum of P g over the contacts with a gap, with the repulsive force P and the gap g.
template <int Dim>
double work_across_gaps(const Packing<Dim>& packing, const BalancedForces<Dim>& forces) {
  double sum = 0.0;
  for (std::size_t k = 0; k < packing.contacts.size(); ++k)
    sum += forces.normal_force[k] * std::max(0.0, packing.contacts[k].gap);
  return sum;
}

TYPED_TEST(StaticForcesOf, ClosestForcesAvoidCostlyGaps) {
  constexpr int Dim = TypeParam::value;
  Packing<Dim> packing = packing_without_forces<Dim>(5);
  for (std::size_t k = 0; k < packing.contacts.size(); ++k) packing.contacts[k].gap = k % 4 == 0 ? 1e-3 : -1e-3;
  StaticForces<Dim> problem("s.h5", packing, under_pressure<Dim>(1.0));
  const BalancedForces<Dim> all = problem.closest(), few = problem.closest(1e-5);
  EXPECT_GT(work_across_gaps(packing, all), 0.0);
  EXPECT_LT(work_across_gaps(packing, few), 0.2 * work_across_gaps(packing, all));
  EXPECT_LT(few.error.force, 1e-9);
  EXPECT_LT(few.error.moment, 1e-9);
  EXPECT_LT(few.error.stress, 1e-9);
  // If there is no gap, no cost is added.
  for (Contact<Dim>& c : packing.contacts) c.gap = -1e-3;
  StaticForces<Dim> closed("s.h5", packing, under_pressure<Dim>(1.0));
  EXPECT_EQ(force_distance(closed.closest(), closed.closest(1e-5)), 0.0);
}

TYPED_TEST(StaticForcesOf, CanonicalForcesHaveTheLeastEnergyOfAllThatBalance) {
  constexpr int Dim = TypeParam::value;
  Packing<Dim> packing = packing_without_forces<Dim>(4);
  const auto energy = [](const BalancedForces<Dim>& f) {
    double sum = 0.0;
    for (std::size_t k = 0; k < f.normal_force.size(); ++k)
      sum += f.normal_force[k] * f.normal_force[k] / 1e4 + f.shear_force[k].squaredNorm() / 5e3;
    return sum;
  };
  const double least = energy(StaticForces<Dim>("s.h5", packing, under_pressure<Dim>(1.0)).canonical());
  for (const double ratio : {0.1, 0.4, 0.6, 2.0, 10.0}) {
    ForceBalanceOptions<Dim> options = under_pressure<Dim>(1.0);
    options.kn = 1.0;
    options.kt = ratio;
    EXPECT_GT(energy(StaticForces<Dim>("s.h5", packing, options).canonical()), least);
  }
}

TYPED_TEST(StaticForcesOf, RangesContainTheForcesThatBalance) {
  constexpr int Dim = TypeParam::value;
  Packing<Dim> packing = packing_without_forces<Dim>(5);
  StaticForces<Dim> problem("s.h5", packing, under_pressure<Dim>(1.0));
  const BalancedForces<Dim> forces = problem.canonical();
  for (const int k : {0, 3, 7}) {
    const ForceRange range = problem.range(k);
    EXPECT_GE(range.smallest, -1e-8);
    EXPECT_LE(range.smallest, forces.normal_force[k] + 1e-8);
    EXPECT_GE(range.largest, forces.normal_force[k] - 1e-8);
    EXPECT_TRUE(std::isfinite(range.largest));
  }
}

TYPED_TEST(StaticForcesOf, AdhesionLetsContactsPull) {
  constexpr int Dim = TypeParam::value;
  Packing<Dim> packing = packing_without_forces<Dim>(6);
  // In each contact, the adhesion is cancelled by an elastic force of 1. The total forces are zero, and they balance
  // the load of zero.
  for (Contact<Dim>& c : packing.contacts) c.elastic_force = 1.0;
  const BalancedForces<Dim> closest = StaticForces<Dim>("s.h5", packing, ForceBalanceOptions<Dim>{}).closest();
  for (const double force : closest.normal_force) EXPECT_NEAR(force, 0.0, 1e-9);
  // Under tension, every contact pulls with at most the adhesion force.
  const BalancedForces<Dim> forces = StaticForces<Dim>("s.h5", packing, under_pressure<Dim>(-0.1)).closest();
  EXPECT_LT(forces.error.force, 1e-9);
  for (const double force : forces.normal_force) EXPECT_GE(force, -1.0 - 1e-9);
}

TEST(StaticForces, NamesTheGrainThatTheLoadMoves) {
  // A row of disks along x cannot carry a stress along y.
  Packing<2> packing = unit_grains<2>({{0.5, 1.5}, {1.5, 1.5}, {2.5, 1.5}}, 3.0, frictional_law());
  EXPECT_EQ(add_near_contacts(packing, 1e-6), 3);
  set_arms(packing);
  StaticForces<2> problem("s.h5", packing, under_pressure<2>(1.0));
  try {
    problem.canonical();
    FAIL() << "expected NoResult";
  } catch (const NoResult& error) {
    EXPECT_THAT(error.what(), HasSubstr("no set of contact forces balances the load"));
  }
}

TEST(StaticForces, RefusesInWordsWhatHasNoSuchForces) {
  Packing<2> packing = packing_without_forces<2>(7);
  const auto expect = [&](const Packing<2>& p, const ForceBalanceOptions<2>& options, const char* words) {
    try {
      StaticForces<2>("s.h5", p, options);
      FAIL() << "expected InputError: " << words;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(words));
    }
  };
  expect(packing, {}, "all contact forces of the packing are zero: give the stress");
  ForceBalanceOptions<2> options = under_pressure<2>(1.0);
  options.friction = -1.0;
  expect(packing, options, "friction = -1: expected a number >= 0");
  options = under_pressure<2>(1.0);
  options.kn = 0.0;
  expect(packing, options, "kn = 0: expected a positive stiffness");
  expect(packing, under_pressure<2>(NAN), "stress: expected finite components");
  expect(packing, under_pressure<2>(0.0), "all contact forces of the packing are zero: give the stress");
  Packing<2> rolling = packing;
  rolling.law += rolling_spring(0.1, 1.0);
  expect(rolling, under_pressure<2>(1.0), "resists rolling or twisting");
  packing.contacts.clear();
  expect(packing, under_pressure<2>(1.0), "no contact can carry a force");
}

TEST(NearContacts, AreThePairsCloserThanTheGapThatAreNotInContact) {
  Packing<2> packing = unit_grains<2>({{0.5, 1.5}, {1.49, 1.5}, {2.51, 1.5}}, 3.0, frictional_law());
  find_contacts(packing);
  // One contact joins the first two disks, and one lies across the cell boundary. Both have an overlap of 0.01.
  ASSERT_EQ(packing.contacts.size(), 2u);
  EXPECT_EQ(add_near_contacts(packing, 0.03), 1);
  ASSERT_EQ(packing.contacts.size(), 3u);
  EXPECT_NEAR(packing.contacts.back().gap, 0.02, 1e-15);
  EXPECT_EQ(add_near_contacts(packing, 0.03), 0);
}

}  // namespace
}  // namespace floc::test
