#include "floc/relaxation/dynamics.h"

#include <gtest/gtest.h>

#include "floc/contact/law_table.h"
#include "floc/packing/balance.h"
#include "floc/relaxation/relaxation_options.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"
#include "support/few_grains.h"
#include "support/lattices.h"
#include "support/laws.h"
#include "support/springs.h"

namespace floc {
namespace {

using test::agitated_gas;
using test::cohesive_law;
using test::pressed;

TEST(Dynamics, ListsLeaveNoTraceInTheBits) {
  test::expect_no_trace_of_lists<2>();
}

TEST(Dynamics, ThreadsLeaveNoTraceInTheBits) {
  test::expect_no_trace_of_threads<2>();
}

TEST(Dynamics, PlacesOfRowsLeaveNoTraceInTheBits) {
  test::expect_no_trace_of_kept_rows(test::large_agitated_gas<2>(cohesive_law()));
}

TEST(Dynamics, VectorInstructionsLeaveNoTraceInTheBits) {
  test::expect_no_trace_of_instructions<2>(50u);
}

/// Returns the total energy of a packing in a cell with inertia M under a pressure (docs/physics.md, "Boundary
/// control").
double total_energy(const Packing<2>& packing, const BoundaryControl<2>& control) {
  const double kn = test::law_number(packing.law, "normal.stiffness");
  double energy =
      0.5 * control.mass * packing.cell.velocity.squaredNorm() + control.target[0] * packing.cell.volume();
  for (int i = 0; i < packing.grains.size(); ++i)
    energy += 0.5 * packing.grains.mass[i] * packing.grains.velocity[i].squaredNorm();
  for (const Contact<2>& c : packing.contacts) energy += 0.5 * kn * c.gap * c.gap;
  return energy;
}

/// Returns the largest relative change of the energy during `n_steps` time steps of length dt.
double energy_drift(double dt, int n_steps) {
  Law law;
  law += test::linear(1.0);
  Packing<2> gas = test::gas_of(100, law, 0.7, 3);
  RandomStream random(4, 2);
  agitate(gas, 0.02, random);
  const BoundaryControl<2> control = pressed(gas, 1e-3);
  const double initial = total_energy(gas, control);
  const auto dynamics = make_dynamics(gas, control, {dt, 0.1});
  double largest = 0.0;
  for (int k = 0; k < 20; ++k) {
    dynamics->advance(n_steps / 20, Motion::free);
    largest = std::max(largest, std::abs(total_energy(dynamics->packing(), control) / initial - 1.0));
  }
  return largest;
}

/// Returns the gas in a cell with other vectors of the same lattice: `by` times the first lattice vector is added to
/// the second one.
Packing<2> leaning(Packing<2> gas, int by) {
  gas.cell.matrix(1, 0) += by * gas.cell.matrix(0, 0);
  gas.contacts.clear();
  return gas;
}

BoundaryControl<2> all_under_stress(const Packing<2>& packing, double pressure) {
  BoundaryControl<2> control = pressed(packing, pressure);
  control.imposed[2] = Imposed::stress;
  return control;
}

/// Returns the largest relative change of the energy, as energy_drift() does, for a cell that can also shear, under
/// zero shear stress.
double energy_drift_of_sheared(double dt, int n_steps) {
  Law law;
  law += test::linear(1.0);
  Packing<2> gas = test::gas_of(100, law, 0.7, 3);
  // Grains overlap across the faces of the sheared cell. The energy of these overlaps sets the cell in motion.
  gas.cell.matrix(1, 0) = 0.3 * gas.cell.matrix(0, 0);
  RandomStream random(4, 2);
  agitate(gas, 0.02, random);
  const BoundaryControl<2> control = all_under_stress(gas, 1e-3);
  const auto dynamics = make_dynamics(gas, control, {dt, 0.1});
  dynamics->advance(1, Motion::free);  // finds the contacts, whose energy is part of the total
  const double initial = total_energy(dynamics->packing(), control);
  double largest = 0.0;
  for (int k = 0; k < 10; ++k) {
    dynamics->advance(n_steps / 10, Motion::free);
    largest = std::max(largest, std::abs(total_energy(dynamics->packing(), control) / initial - 1.0));
  }
  EXPECT_NE(dynamics->packing().cell.velocity(1, 0), 0.0);
  return largest;
}

TEST(TriangularLattice, UnderStressConservesEnergyToSecondOrder) {
  const double coarse = energy_drift_of_sheared(0.1, 2000);
  const double fine = energy_drift_of_sheared(0.025, 8000);
  EXPECT_LT(fine, 0.15 * coarse);
}

TEST(TriangularLattice, OfOtherVectorsGivesTheSameMotion) {
  const Packing<2> gas = agitated_gas(60, cohesive_law());
  const double dt = time_step_of(gas, 0.2);
  const auto control = pressed(gas, 0.01);
  const auto straight = make_dynamics(gas, control, {dt, 0.05});
  const auto leant = make_dynamics(leaning(gas, 1), control, {dt, 0.05});
  straight->advance(100, Motion::free);
  leant->advance(100, Motion::free);
  const Packing<2> p = straight->packing(), q = leant->packing();
  ASSERT_EQ(p.contacts.size(), q.contacts.size());
  EXPECT_GT(p.contacts.size(), 5u);
  // Within a hundred steps, collisions amplify rounding errors.
  EXPECT_NEAR(q.cell.matrix(0, 0), p.cell.matrix(0, 0), 1e-9);
  EXPECT_NEAR(q.cell.matrix(1, 1), p.cell.matrix(1, 1), 1e-9);
  for (int i = 0; i < p.grains.size(); ++i)
    EXPECT_NEAR((p.grains.velocity[i] - q.grains.velocity[i]).norm(), 0.0, 1e-6);
}

TEST(TriangularLattice, ShearsAtTheRateGiven) {
  const Packing<2> gas = agitated_gas(60, cohesive_law());
  const double dt = time_step_of(gas, 0.2);
  BoundaryControl<2> control = pressed(gas, 0.01);
  control.target[2] = -1e-2;  // gamma increases; its sign is opposite to that of shortening
  control.target[0] = 5e-3;
  control.imposed[0] = Imposed::rate;
  const auto dynamics = make_dynamics(gas, control, {dt, 0.05});
  dynamics->advance(400, Motion::free);
  const Packing<2> p = dynamics->packing();
  const Mat<2> gradient = p.cell.rate();
  EXPECT_NEAR(gradient(0, 1), 1e-2, 1e-12);
  EXPECT_NEAR(gradient(1, 0), 0.0, 1e-15);
  EXPECT_NEAR(gradient(0, 0), -5e-3, 1e-12);
  EXPECT_NEAR(std::log(p.cell.matrix(0, 0) / gas.cell.matrix(0, 0)), -5e-3 * 400 * dt, 1e-9);
}

TEST(Dynamics, FrictionlessUndampedCellConservesEnergyToSecondOrder) {
  const double coarse = energy_drift(0.1, 4000);
  const double fine = energy_drift(0.025, 16000);
  EXPECT_LT(coarse, 2e-3);
  // For a method of second order, the error with a quarter of the step is ideally 1/16 of the error. The forces of
  // contacts that open and close are not smooth, so 1/8 is accepted.
  EXPECT_LT(fine, coarse / 8.0);
}

/// Returns the coefficient of restitution of two disks that collide head on without adhesion. The time step is the
/// usual step of a packing with diameters in [1/2, 1].
/// @param phase  fraction of a step at which the disks begin to overlap
double measured_restitution(double diameter_i, double diameter_j, double phase) {
  Law law;
  law += test::linear(1e5);
  law += test::viscous_damping(0.015);
  law += test::coulomb(0.5, 1e5);
  Packing<2> pair;
  pair.law = law;
  pair.cell.matrix *= 10.0;
  pair.grains = Grains<2>::with_size(3);
  // The third disk is the smallest and determines the time step.
  pair.grains.radius = {0.5 * diameter_i, 0.5 * diameter_j, 0.25};
  pair.grains.mass = {diameter_i * diameter_i, diameter_j * diameter_j, 0.25};
  const double dt = time_step_of(pair, RelaxationOptions{}.time_step);
  const double speed = 1e-3;
  const double apart = pair.grains.radius[0] + pair.grains.radius[1] + 2.0 * speed * dt * (1.0 + phase);
  pair.grains.position = {Vec<2>(4.0, 4.0), Vec<2>(4.0 + apart, 4.0), Vec<2>(1.0, 1.0)};
  pair.grains.velocity[0] = Vec<2>(speed, 0.0);
  pair.grains.velocity[1] = Vec<2>(-speed, 0.0);
  const auto fixed = BoundaryControl<2>::fixed();
  const auto dynamics = make_dynamics(pair, fixed, {dt, 0.1});
  dynamics->advance(400, Motion::free);
  const Packing<2> parted = dynamics->packing();
  EXPECT_TRUE(parted.contacts.empty());
  return (parted.grains.velocity[1] - parted.grains.velocity[0])[0] / (2.0 * speed);
}

double mean_restitution(double diameter_i, double diameter_j) {
  constexpr int kPhases = 1000;
  double sum = 0.0;
  for (int k = 0; k < kPhases; ++k) sum += measured_restitution(diameter_i, diameter_j, (k + 0.5) / kPhases);
  return sum / kPhases;
}

/// The expected coefficients of restitution are those in the comment of RelaxationOptions::time_step.
TEST(Dynamics, RestitutionIsRightAtTheDefaultStep) {
  EXPECT_NEAR(mean_restitution(1.0, 1.0), 0.015, 0.02 * 0.015);
  EXPECT_NEAR(mean_restitution(0.5, 1.0), 0.018, 0.001);
  EXPECT_NEAR(mean_restitution(0.5, 0.5), 0.025, 0.001);
}

/// Returns two spinning disks that move towards each other: a large disk on the left, and a disk of half its size on
/// the right. If `mirrored`, returns the mirror image, in which the numbers of the two disks are exchanged.
Packing<2> unequal_pair(const Law& law, bool mirrored) {
  const int large = mirrored ? 1 : 0, small = 1 - large;
  const double sign = mirrored ? -1.0 : 1.0;
  Packing<2> pair;
  pair.law = law;
  pair.cell.matrix *= 8.0;
  Grains<2>& g = pair.grains;
  g = Grains<2>::with_size(2);
  g.radius[large] = 0.5, g.radius[small] = 0.25;
  g.mass[large] = 1.0, g.mass[small] = 0.25;
  g.position[large] = {4.0 - sign * 0.5, 4.0};
  g.position[small] = {4.0 + sign * 0.252, 4.0};
  g.velocity[large] = {sign, 0.0};
  g.velocity[small] = {-sign, 0.0};
  g.angular_velocity[large][0] = sign * 0.5;
  g.angular_velocity[small][0] = sign * 0.3;
  return pair;
}

/// Returns the grains after the collision.
Grains<2> parted(const Packing<2>& pair) {
  const auto fixed = BoundaryControl<2>::fixed();
  const double time_step = time_step_of(pair, RelaxationOptions{}.time_step);
  const auto dynamics = make_dynamics(pair, fixed, {time_step, 0.1});
  dynamics->advance(static_cast<int>(0.1 / time_step), Motion::free);
  const Packing<2> end = dynamics->packing();
  EXPECT_TRUE(end.contacts.empty());
  return end.grains;
}

void expect_mirror_images(const Law& law) {
  const Grains<2> g = parted(unequal_pair(law, false));
  const Grains<2> m = parted(unequal_pair(law, true));
  const double restitution = (g.velocity[1][0] - g.velocity[0][0]) / 2.0;
  EXPECT_GT(restitution, 0.0);
  EXPECT_LT(restitution, 1.01);  // 1 without damping, up to the error of the first step with overlap
  // The rounding errors of positions differ by 1e-15 between the two collisions; overlaps are 1e-3.
  constexpr double kRounding = 1e-9;
  EXPECT_NEAR((m.velocity[0][0] - m.velocity[1][0]) / -2.0, restitution, kRounding);
  for (const int grain : {0, 1}) {
    const int image = 1 - grain;
    EXPECT_NEAR(m.velocity[image][0], -g.velocity[grain][0], kRounding);
    EXPECT_NEAR(m.velocity[image][1], g.velocity[grain][1], kRounding);
    EXPECT_NEAR(m.angular_velocity[image][0], -g.angular_velocity[grain][0], kRounding);
    EXPECT_NEAR(m.position[image][0], 8.0 - g.position[grain][0], kRounding);
  }
}

TEST(Dynamics, MirrorImagesOfUnequalGrainsCollideAlike) {
  test::for_each_law([](const auto& law) {
    if (law.kDimension == 3) return;
    Law parameters = test::parameters_of(law);
    expect_mirror_images(parameters);
    if (!parameters.has_damping()) return;
    SCOPED_TRACE("critical damping by the mass of a grain");
    parameters += test::chosen("damping.mass", "grain");
    expect_mirror_images(parameters);
  });
}

TEST(Dynamics, CohesivePairRestsAtThePullOffOverlap) {
  const Packing<2> pair = test::unit_grains<2>({{4.0, 4.0}, {5.0, 4.0}}, 10.0, cohesive_law());
  const auto fixed = BoundaryControl<2>::fixed();
  const auto dynamics = make_dynamics(pair, fixed, {time_step_of(pair, 0.2), 0.1});
  dynamics->advance(2000, Motion::free);
  const Packing<2> rest = dynamics->packing();
  ASSERT_EQ(rest.contacts.size(), 1u);
  // The gap at rest is -F0/K_N. The vibration decays to rounding errors within 2000 steps.
  EXPECT_NEAR(rest.contacts[0].gap, -1e-5, 1e-12);
  EXPECT_NEAR(rest.contacts[0].normal_force, 0.0, 1e-7);
}

TEST(Dynamics, GrainTouchesItsOwnImage) {
  const Packing<2> one = test::unit_grains<2>({{0.3, 0.4}}, 0.99, test::law_of({test::linear(1.0)}));
  const auto fixed = BoundaryControl<2>::fixed();
  const auto dynamics = make_dynamics(one, fixed, {0.1, 0.05});
  dynamics->advance(10, Motion::free);
  const Packing<2> still = dynamics->packing();
  ASSERT_EQ(still.contacts.size(), 2u);
  for (const Contact<2>& c : still.contacts) EXPECT_NEAR(c.normal_force, 0.01, 1e-15);
  EXPECT_EQ(still.grains.velocity[0], Vec<2>::Zero());
}

/// Agitates a crystal slightly. Returns the factor by which its kinetic energy grows within the given number of
/// steps.
double growth_in_crystal(int n_steps, double time_step, double restitution, double rolling_stiffness) {
  Law law;
  law += test::linear(1.0);
  law += test::viscous_damping(restitution);
  law += test::coulomb(10.0, 1.0);
  if (rolling_stiffness > 0.0) law += test::rolling_spring(10.0, rolling_stiffness);
  Packing<2> crystal = test::triangular_crystal(8, 1.0, law);
  RandomStream random(1, 1);
  agitate(crystal, 1e-8, random);
  for (auto& spin : crystal.grains.angular_velocity) spin[0] = 1e-8;  // this mode becomes unstable first
  const auto fixed = BoundaryControl<2>::fixed();
  const auto dynamics = make_dynamics(crystal, fixed, {time_step_of(crystal, time_step), 0.1});
  dynamics->advance(n_steps, Motion::free);
  return mean_kinetic_energy(dynamics->packing()) / mean_kinetic_energy(crystal);
}

/// The expected limits of the time step are those in the comment of RelaxationOptions::time_step. For rolling
/// stiffnesses above about 0.2, the default step is shorter.
TEST(TimeStep, LeavesCrystalsStable) {
  for (const double restitution : {0.015, 0.5}) {
    EXPECT_LT(growth_in_crystal(3000, 0.40, restitution, 0.0), 1.0);
    EXPECT_GT(growth_in_crystal(30, 0.42, restitution, 0.0), 1e3);
    for (const double rolling : {0.1, 0.2, 0.3, 1.0, 10.0})
      EXPECT_LT(growth_in_crystal(3000, RelaxationOptions{}.time_step, restitution, rolling), 1.0) << rolling;
  }
}

TEST(TimeStep, IsShortenedWhereRollingIsFast) {
  Packing<2> packing = test::gas_of(10, cohesive_law(), 0.3);
  const double vibration = time_step_of(packing, 0.2);
  EXPECT_NEAR(vibration, 0.2 * std::sqrt(0.25 / 1e5), 1e-15);
  packing.law += test::changed("rolling.stiffness", 1e5);
  EXPECT_LT(time_step_of(packing, 0.2), 0.5 * vibration);
}

}  // namespace
}  // namespace floc
