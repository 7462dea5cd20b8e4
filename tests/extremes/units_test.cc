#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/elasticity/moduli.h"
#include "floc/loading/run.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"
#include "support/law_units.h"
#include "support/network_packings.h"
#include "support/springs.h"

/// Tests that results do not depend on the units of length, force and mass, even if the numbers in these units are near
/// the ends of the range of doubles.
namespace floc {
namespace {

/// Units of a rescaled packing, measured in the units of the original packing.
struct Units {
  double length = 1.0, force = 1.0, mass = 1.0;

  double stiffness() const { return force / length; }
  double moment() const { return force * length; }
  double time() const { return std::sqrt(mass * length / force); }
};

Law rescaled(const Law& law, const Units& u) {
  return test::in_units(law, u.length, u.force);
}

template <int Dim>
Packing<Dim> rescaled(Packing<Dim> packing, const Units& u) {
  packing.law = rescaled(packing.law, u);
  packing.cell.matrix *= u.length;
  for (Vec<Dim>& x : packing.grains.position) x *= u.length;
  for (Vec<Dim>& x : packing.grains.position_low) x *= u.length;
  for (double& radius : packing.grains.radius) radius *= u.length;
  for (double& mass : packing.grains.mass) mass *= u.mass;
  find_contacts(packing);
  return packing;
}

template <int Dim>
void expect_same_moduli_in_all_units() {
  const Packing<Dim> packing = test::random_packing<Dim>(30, 4, test::elastic_law(1.0, 0.6, 0.05), 2.5);
  ModuliOptions options;
  options.strains = StrainSet::full;
  const Moduli reference = elastic_moduli(packing, options);
  for (const double length : {1e-30, 1.0, 1e30})
    for (const double force : {1e-30, 1.0, 1e30})
      for (const double mass : {1e-30, 1e30}) {
        const Units u{length, force, mass};
        const Packing<Dim> changed = rescaled(packing, u);
        ASSERT_EQ(changed.contacts.size(), packing.contacts.size());
        const Moduli m = elastic_moduli(changed, options);
        const double stress = force / std::pow(length, Dim - 1);
        const double worst = (m.C / stress - reference.C).cwiseAbs().maxCoeff();
        EXPECT_LE(worst, 1e-12 * reference.C.cwiseAbs().maxCoeff())
            << "length " << length << ", force " << force;
        EXPECT_EQ(m.n_mechanisms, reference.n_mechanisms);
        EXPECT_EQ(m.n_negative, reference.n_negative);
        EXPECT_NEAR(m.B_error / stress / reference.B_error, 1.0, 1.0)
            << "length " << length << ", force " << force;
      }
}

TEST(Units, OfDisksLeaveTheModuliAsTheyAre) {
  expect_same_moduli_in_all_units<2>();
}
TEST(Units, OfSpheresLeaveTheModuliAsTheyAre) {
  expect_same_moduli_in_all_units<3>();
}

RunOptions run_options(AssemblyOptions::Protocol protocol, const Units& u) {
  RunOptions options;
  options.grains.count = 30;
  options.grains.diameter.min = 0.5 * u.length;
  options.grains.diameter.max = u.length;
  options.grains.density = 4.0 / std::numbers::pi * u.mass / (u.length * u.length);
  options.law = rescaled(test::cohesive_law(), u);
  options.assembly.protocol = protocol;
  options.assembly.solid_fraction = 0.5;
  options.assembly.agitation = 5.0;
  options.assembly.pressure = 0.125 * u.stiffness();
  LoadStage load;
  load.to = 4.0 * u.stiffness();
  load.steps = 2;
  options.load = {load};
  options.relaxation.strain_rate_cap = 0.05;
  return options;
}

/// Returns the states of a whole path.
std::vector<Packing<2>> path(const RunOptions& options) {
  floc::Run<2> run(options);
  std::vector<Packing<2>> states;
  while (!run.finished()) {
    const RunEvent event = run.advance();
    if (event == RunEvent::gave_up) break;
    if (event != RunEvent::equilibrium) continue;
    states.push_back(run.state().packing);
    run.saved("");
  }
  EXPECT_EQ(states.size(), run.plan().size());
  return states;
}

/// If the units are powers of two, even very large ones, rounding does not depend on the units. The whole path must
/// therefore be identical bit for bit.
void expect_same_path(AssemblyOptions::Protocol protocol) {
  const std::vector<Packing<2>> reference = path(run_options(protocol, {}));
  // The unit of time is a power of two as well. 2^100 is 1.3e30.
  const Units powers[] = {{std::exp2(100), 1.0, 1.0},
                          {std::exp2(-100), 1.0, 1.0},
                          {1.0, std::exp2(100), 1.0},
                          {1.0, std::exp2(-100), 1.0},
                          {1.0, 1.0, std::exp2(100)},
                          {1.0, 1.0, std::exp2(-100)},
                          {std::exp2(-3), std::exp2(-10), std::exp2(11)}};
  for (const Units& u : powers) {
    const std::vector<Packing<2>> states = path(run_options(protocol, u));
    ASSERT_EQ(states.size(), reference.size());
    for (std::size_t s = 0; s < states.size(); ++s) {
      const Packing<2>&p = reference[s], &q = states[s];
      EXPECT_EQ(q.cell.matrix, u.length * p.cell.matrix);
      for (int i = 0; i < p.grains.size(); ++i) {
        EXPECT_EQ(q.grains.position[i], u.length * p.grains.position[i]) << "state " << s << " grain " << i;
        EXPECT_EQ(q.grains.velocity[i], u.length / u.time() * p.grains.velocity[i])
            << "state " << s << " grain " << i;
        EXPECT_EQ(q.grains.orientation[i], p.grains.orientation[i]) << "state " << s << " grain " << i;
      }
      ASSERT_EQ(q.contacts.size(), p.contacts.size());
      for (std::size_t c = 0; c < p.contacts.size(); ++c) {
        EXPECT_EQ(q.contacts[c].normal_force, u.force * p.contacts[c].normal_force);
        EXPECT_EQ(test::shear_spring(q.contacts[c]), u.length * test::shear_spring(p.contacts[c]));
        EXPECT_EQ(test::rolling_spring(q.contacts[c]), test::rolling_spring(p.contacts[c]));
      }
    }
  }
}

TEST(Units, ThatArePowersOfTwoLeaveEveryBitOfADirectPath) {
  expect_same_path(AssemblyOptions::Protocol::direct);
}
TEST(Units, ThatArePowersOfTwoLeaveEveryBitOfAPathFromAnAggregate) {
  expect_same_path(AssemblyOptions::Protocol::aggregation);
}

}  // namespace
}  // namespace floc
