#include "floc/structure/energy_account.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "floc/packing/law/contact_forces.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"

namespace floc {
namespace {

Law beads_law() {
  Law law;
  law += test::hertz(1e5, 0.3);
  law += test::mindlin(0.3);
  law += test::critical_damping(0.3);
  return law;
}

template <int Dim>
Law full_law() {
  Law law = test::cohesive_law();
  law += test::linear(1e3);
  law += test::coulomb(0.3, 800.0);
  law += test::rolling_spring(0.02, 10.0);
  law += test::viscous_damping(0.5);
  if (Dim == 3) law += test::twisting_spring(0.01, 8.0);
  return law;
}

/// Returns the energy account of a dense gas whose cell deforms, with random rates of all strain components.
/// @param step_share  time step divided by the usual one
template <int Dim>
EnergyTerms deformed(const Law& law, std::uint64_t seed, double step_share) {
  RandomStream random(seed, 3);
  Packing<Dim> start = test::gas_of<Dim>(Dim == 2 ? 40 : 30, law, Dim == 2 ? 0.6 : 0.45, seed);
  agitate(start, 0.3, random);
  BoundaryControl<Dim> control = BoundaryControl<Dim>::fixed();
  for (int k = 0; k < kSymmetric<Dim>; ++k)
    control.target[k] = k < Dim ? 0.4 + 0.6 * random.uniform() : random.uniform() - 0.5;
  const double step = step_share * time_step_of(start, 0.36, 10.0);
  const auto dynamics = make_dynamics(start, control, {step, 0.1});
  EnergyAccount<Dim> account(dynamics->packing());
  const int n_steps = static_cast<int>(0.3 / step);
  for (int k = 0; k < n_steps; ++k) {
    dynamics->advance(1, Motion::free);
    account.advance(dynamics->packing(), step);
  }
  return account.terms();
}

/// Tests ten random loadings. Viscous forces are computed from the velocities half a step earlier, so the error of the
/// energy account is of first order in the time step.
template <int Dim>
void expect_to_close(const Law& law) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const EnergyTerms coarse = deformed<Dim>(law, seed, 0.2), t = deformed<Dim>(law, seed, 0.1);
    EXPECT_GT(t.work, 0.0);
    EXPECT_GT(t.viscous, 0.0);
    EXPECT_GT(t.sliding, 0.0);
    EXPECT_EQ(t.removed, 0.0);
    EXPECT_EQ(t.scaling > 0.0, law.friction_follows_load());
    EXPECT_LT(std::abs(t.error()), 0.003 * t.work);
    EXPECT_NEAR(coarse.error() / t.error(), 2.0, 0.1);
  }
}

TEST(EnergyAccount, ClosesForDisksToFirstOrder) {
  expect_to_close<2>(full_law<2>());
}

TEST(EnergyAccount, ClosesForSpheresToFirstOrder) {
  expect_to_close<3>(full_law<3>());
}

TEST(EnergyAccount, ClosesForHertzAndMindlinToFirstOrder) {
  expect_to_close<3>(beads_law());
}

Law wet_law(const std::string& formation, const std::string& form) {
  Law law;
  law += test::linear(1e3);
  law += test::coulomb(0.3, 800.0);
  law += test::viscous_damping(0.5);
  law += test::liquid(1.0, 20.0, 0.02, 2.6, form, formation);
  return law;
}

/// The account has a separate term for two changes of energy: bridges form, and liquid is redistributed. The error of
/// the balance is of first order in the time step.
TEST(EnergyAccount, ClosesForWetGrainsToFirstOrder) {
  std::cout << "formation form: error at a step, at half of it, order; work, liquid\n";
  for (const char* const formation : {"gap", "contact"})
    for (const char* const form : {"exponential", "rational"}) {
      double coarse = 0.0, fine = 0.0;
      EnergyTerms t;
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Law law = wet_law(formation, form);
        coarse += std::abs(deformed<3>(law, seed, 0.1).error());
        t = deformed<3>(law, seed, 0.05);
        fine += std::abs(t.error());
        EXPECT_LT(std::abs(t.error()), 0.003 * t.work) << seed;
        EXPECT_NE(t.liquid, 0.0);
      }
      const double order = std::log2(coarse / fine);
      std::cout << formation << " " << form << ": " << coarse / 5 << " " << fine / 5 << " " << order << "; "
                << t.work << " " << t.liquid << "\n";
      EXPECT_GT(order, 0.7);
    }
}

/// Returns a packing whose contacts carry shear forces and rolling moments.
Packing<2> strained_packing(const Law& law) {
  const Packing<2> start = test::gas_of<2>(40, law, 0.6, 1);
  BoundaryControl<2> control = BoundaryControl<2>::fixed();
  control.target = {0.8, 0.6, 0.3};
  const double step = 0.2 * time_step_of(start, 0.36, 10.0);
  const auto dynamics = make_dynamics(start, control, {step, 0.1});
  dynamics->advance(static_cast<int>(0.3 / step), Motion::free);
  return dynamics->packing();
}

/// A stage of a run may change the law. The contacts then keep their histories, as in this test.
TEST(EnergyAccount, KeepsSpringsWhereTheLawChanges) {
  const Packing<2> packing = strained_packing(full_law<2>());
  Law rougher = packing.law, stiffer = packing.law;
  rougher += test::coulomb(0.6, 800.0);
  stiffer += test::coulomb(0.3, 1600.0);
  for (const Law& law : {rougher, stiffer}) {
    EnergyAccount<2> account(packing);
    account.change_law(law);
    Packing<2> refreshed = packing;
    refreshed.law = law;
    refresh_contacts(refreshed);
    const double elastic = EnergyAccount<2>(refreshed).terms().elastic;
    // The two sums have the same number of terms in a different order.
    const double rounding = 1e-13 * elastic;
    EXPECT_NEAR(account.terms().elastic, elastic, rounding);
    EXPECT_NEAR(account.terms().law, elastic - EnergyAccount<2>(packing).terms().elastic, rounding);
    EXPECT_NEAR(account.terms().error(), 0.0, rounding);
  }
  EnergyAccount<2> account(packing);
  account.change_law(rougher);
  EXPECT_NEAR(account.terms().law, 0.0, 1e-13 * account.terms().elastic);  // no spring exceeds its limit
}

}  // namespace
}  // namespace floc
