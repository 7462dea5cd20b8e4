#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/neighbors/spread_liquid.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/relaxation/relaxer.h"
#include "floc/structure/energy_account.h"
#include "support/contact_laws.h"
#include "support/crystals.h"
#include "support/dynamics.h"
#include "support/few_grains.h"
#include "support/wet_packings.h"

namespace floc {
namespace {

using test::after;
using test::agitated_gas;
using test::all_volumes;
using test::expect_same_bits;
using test::liquid_of;

/// Law with liquid bridges. The units are the diameter a of a grain and the force F0 of a bridge between two grains of
/// diameter a.
Law wet_law(double water, const std::string& formation = "gap") {
  Law law;
  law += test::linear(1e5);
  law += test::liquid(1.0 / std::numbers::pi, 0.0, water, 2.5, "exponential", formation);
  law += test::viscous_damping(0.015);
  law += test::coulomb(0.5, 1e5);
  return law;
}

template <int Dim>
int count_distant(const Packing<Dim>& packing) {
  int n = 0;
  for (const Contact<Dim>& c : packing.contacts) n += c.distant;
  return n;
}

/// Returns two grains of diameter one, separated by a gap, without damping and friction.
Packing<3> doublet(double gap, double water) {
  Packing<3> pair = test::unit_grains<3>({{4.0, 4.0, 4.0}, {5.0 + gap, 4.0, 4.0}}, 10.0, wet_law(water));
  pair.law += test::without("damping");
  pair.law += test::without("friction");
  find_contacts(pair);
  return pair;
}

double energy_of(const Packing<3>& packing) {
  const EnergyTerms terms = EnergyAccount<3>(packing).terms();
  return terms.elastic + terms.kinetic;
}

TEST(WetGrains, WithoutLiquidMoveAsDryOnesBitForBit) {
  Law dry = wet_law(0.0);
  const Packing<2> wet_gas = agitated_gas<2>(150, dry);
  dry += test::without("adhesion");
  const Packing<2> dry_gas = agitated_gas<2>(150, dry);
  const double dt = time_step_of(dry_gas, RelaxationOptions{}.time_step);
  expect_same_bits(after(wet_gas, {dt, 0.05}, {600}), after(dry_gas, {dt, 0.05}, {600}));
}

template <int Dim>
void expect_no_trace() {
  const Packing<Dim> gas = agitated_gas<Dim>(150, wet_law(2e-3));
  const double dt = time_step_of(gas, RelaxationOptions{}.time_step);
  const Packing<Dim> one = after(gas, {dt, 0.05, 1, InstructionSet::portable}, {600});
  EXPECT_GT(count_distant(one), 20);
  expect_same_bits(one, after(gas, {dt, 0.3, 1, InstructionSet::portable}, {600}));
  expect_same_bits(one, after(gas, {dt, 0.05, 2, InstructionSet::portable}, {100, 500}));
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512})
    if (supported(set)) expect_same_bits(one, after(gas, {dt, 0.05, 1, set}, {600}));
}

TEST(WetGrains, SkinThreadsAndInstructionsLeaveNoTrace) {
  expect_no_trace<2>();
  expect_no_trace<3>();
}

template <int Dim>
void expect_liquid_kept(const std::string& formation) {
  Packing<Dim> packing = agitated_gas<Dim>(150, wet_law(2e-3, formation));
  const double dt = time_step_of(packing, RelaxationOptions{}.time_step);
  int n_chunks_with_liquid = 0;
  for (int chunk = 0; chunk < 20; ++chunk) {
    packing = after(packing, {dt, 0.05}, {200});
    if (packing.contacts.empty()) continue;
    const double sum = all_volumes(packing);
    if (sum == 0.0) continue;  // no bridges yet, because no grains have touched
    EXPECT_NEAR(sum, liquid_of(packing), 1e-12 * liquid_of(packing)) << "chunk " << chunk;
    ++n_chunks_with_liquid;
  }
  EXPECT_GT(n_chunks_with_liquid, 10);
}

TEST(WetGrains, KeepTheirLiquidOverAWholePath) {
  expect_liquid_kept<2>("gap");
  expect_liquid_kept<3>("gap");
  expect_liquid_kept<2>("contact");
  expect_liquid_kept<3>("contact");
}

TEST(WetGrains, ListsInMotionShareLiquidAsThePackingDoes) {
  const Packing<3> gas = agitated_gas<3>(150, wet_law(2e-3));
  const double dt = time_step_of(gas, RelaxationOptions{}.time_step);
  Packing<3> packing = after(gas, {dt, 0.05}, {600});
  spread_liquid(packing);
  // A new neighbour list distributes the liquid before the first step.
  const Packing<3> again = after(packing, {dt, 0.05}, {0});
  ASSERT_EQ(again.contacts.size(), packing.contacts.size());
  for (std::size_t k = 0; k < again.contacts.size(); ++k) {
    const double volume = bridge_volume(packing, packing.contacts[k]);
    EXPECT_NEAR(bridge_volume(again, again.contacts[k]), volume, 1e-12 * volume);
  }
}

TEST(WetGrains, ADoubletBouncesForEverWithAllOfItsEnergy) {
  Packing<3> pair = doublet(0.0, 2e-3);
  const double reach = interaction_range(pair);
  pair = doublet(0.3 * reach, 2e-3);
  const double energy = energy_of(pair);
  EXPECT_LT(energy, 0.0);
  const double dt = 0.05 * time_step_of(pair, RelaxationOptions{}.time_step);
  double largest = 0.0;
  bool apart = false, touching = false;
  const auto dynamics = make_dynamics(pair, BoundaryControl<3>::fixed(), {dt, 0.05});
  for (int k = 0; k < 200; ++k) {
    dynamics->advance(1000, Motion::free);
    const Packing<3> now = dynamics->packing();
    ASSERT_EQ(now.contacts.size(), 1u);
    (now.contacts[0].distant ? apart : touching) = true;
    largest = std::max(largest, std::abs(energy_of(now) - energy));
  }
  EXPECT_TRUE(apart);
  EXPECT_TRUE(touching);
  // When the surfaces meet, the stiffness jumps by K_N. The step in which this happens changes the energy by an error
  // of about K_N (v dt)^2/8.
  EXPECT_LT(largest, 5e-4 * std::abs(energy));
}

TEST(WetGrains, SimpleCubicCrystalRestsAtThePullOffOverlapAndBreaksAtThePullOfItsPlanes) {
  Law law = wet_law(2e-3);
  const double h0 = 1.0 / 1e5;  // F0/K_N
  const Packing<3> rest = test::crystal_of(test::simple_cubic(), 1.0 - h0, 1.0, law);
  ASSERT_EQ(rest.contacts.size(), 3u);
  EXPECT_NEAR(static_stress(rest).trace() / 3.0, 0.0, 1e-10);
  const Packing<3> about_to_break = test::crystal_of(test::simple_cubic(), 1.0, 1.0, law);
  EXPECT_NEAR(static_stress(about_to_break)(0, 0), -1.0, 1e-10);
  const double h = 0.02;
  const Packing<3> apart = test::crystal_of(test::simple_cubic(), 1.0 + h, 1.0, law);
  ASSERT_EQ(count_distant(apart), 3);
  const double volume = liquid_of(apart) / 3.0;
  EXPECT_NEAR(bridge_volume(apart, apart.contacts[0]), volume, 1e-14 * volume);
  const double l = 0.9 * std::sqrt(volume / 0.5);
  EXPECT_NEAR(static_stress(apart)(0, 0), -std::exp(-h / l) / ((1.0 + h) * (1.0 + h)), 1e-12);
  for (const Contact<3>& c : apart.contacts) {
    EXPECT_NEAR(c.kn, -std::exp(-h / l) / l, 1e-12 / l);
    EXPECT_EQ(c.kt, 0.0);
  }
}

TEST(WetGrains, BondsCarryTheStressDistantOnesIncluded) {
  const Packing<3> packing = test::random_packing<3>(30, 3, wet_law(5e-3), 0.9);
  ASSERT_GT(count_distant(packing), 5);
  double sum = 0.0;
  for (const Contact<3>& c : packing.contacts) sum += c.normal_force * branch(packing, c).norm();
  EXPECT_NEAR(sum, static_stress(packing).trace() * packing.cell.volume(), 1e-9 * std::abs(sum));
}

RelaxationOptions settling() {
  RelaxationOptions options;
  options.strain_rate_cap = 0.05;
  options.threads = 1;
  return options;
}

template <int Dim>
void expect_equilibrium_with_its_liquid_at_rest(const Law& law, double pressure) {
  Packing<Dim> gas = test::gas_of<Dim>(Dim == 2 ? 60 : 40, law, Dim == 2 ? 0.7 : 0.5);
  Relaxer<Dim> relaxer(settling(), gas, Vec<Dim>(Vec<Dim>::Constant(pressure)));
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running) status = relaxer.advance();
  ASSERT_EQ(status, RelaxationStatus::converged) << relaxer.report().blocking;
  const Packing<Dim>& packing = relaxer.packing();
  EXPECT_NEAR(all_volumes(packing), liquid_of(packing), 1e-12 * liquid_of(packing));
  Packing<Dim> again = packing;
  EXPECT_EQ(spread_liquid(again).n_changed(), relaxer.report().n_bridges_unsettled);
  EXPECT_EQ(relaxer.report().n_bridges_unsettled, 0);
  EXPECT_TRUE(relaxer.report().residuals.within(settling().tolerance));
  EXPECT_GT(count_distant(packing), 0);
}

TEST(WetGrains, ComeToRestWithTheirLiquid) {
  expect_equilibrium_with_its_liquid_at_rest<2>(wet_law(2e-3), 0.5);
  expect_equilibrium_with_its_liquid_at_rest<3>(wet_law(2e-3), 0.5);
}

}  // namespace
}  // namespace floc
