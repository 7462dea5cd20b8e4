#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <numeric>

#include "floc/assembly/gas.h"
#include "floc/packing/tile.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/relaxation_options.h"
#include "support/contact_laws.h"

namespace floc::test {

/// Returns a gas of grains whose diameters are uniformly distributed in [1/2, 1].
template <int Dim = 2>
Packing<Dim> gas_of(int n, const Law& law, double solid_fraction, std::uint64_t seed = 1) {
  GrainOptions grains;
  grains.count = n;
  grains.diameter.min = 0.5;
  grains.diameter.max = 1.0;
  RandomStream random(seed, 1);
  return make_gas<Dim>(grains, law, solid_fraction, random);
}

/// Returns an agitated gas of cohesive grains. The gas is so dense that many contacts form within a few hundred steps.
template <int Dim = 2>
Packing<Dim> agitated_gas(int n, const Law& law) {
  Packing<Dim> gas = gas_of<Dim>(n, law, Dim == 2 ? 0.6 : 0.45);
  RandomStream random(7, 2);
  agitate(gas, 1.0, random);
  return gas;
}

/// Returns an agitated gas with many blocks of grains, so that the forces of the first blocks are summed before those
/// of the last blocks are computed. The cell is so long that two threads share only a few blocks.
template <int Dim>
Packing<Dim> large_agitated_gas(const Law& law) {
  Vec<Dim, int> copies = Vec<Dim, int>::Ones();
  copies[Dim - 1] = 36;
  Packing<Dim> gas = tiled<Dim>(agitated_gas<Dim>(300, law), copies);
  RandomStream random(8, 2);
  agitate(gas, 1.0, random);
  return gas;
}

template <int Dim>
double total_mass(const Packing<Dim>& packing) {
  return std::accumulate(packing.grains.mass.begin(), packing.grains.mass.end(), 0.0);
}

template <int Dim>
BoundaryControl<Dim> pressed(const Packing<Dim>& packing, double pressure) {
  return BoundaryControl<Dim>::normal_stress(Vec<Dim>::Constant(pressure), total_mass(packing));
}

template <int Dim>
Packing<Dim> after(const Packing<Dim>& start, const DynamicsSettings& settings,
                   std::initializer_list<int> chunks) {
  const auto dynamics = make_dynamics(start, pressed(start, 0.1), settings);
  for (const int n : chunks) dynamics->advance(n, Motion::free);
  return dynamics->packing();
}

template <int Dim>
void expect_same_bits(const Packing<Dim>& p, const Packing<Dim>& q) {
  EXPECT_EQ(p.grains.position, q.grains.position);
  EXPECT_EQ(p.grains.velocity, q.grains.velocity);
  EXPECT_EQ(p.grains.angular_velocity, q.grains.angular_velocity);
  for (int i = 0; i < p.grains.size(); ++i) {
    if constexpr (Dim == 2)
      EXPECT_EQ(p.grains.orientation[i], q.grains.orientation[i]);
    else
      EXPECT_EQ(p.grains.orientation[i].coeffs(), q.grains.orientation[i].coeffs());
  }
  EXPECT_EQ(p.cell.matrix, q.cell.matrix);
  EXPECT_EQ(p.cell.velocity, q.cell.velocity);
  ASSERT_EQ(p.contacts.size(), q.contacts.size());
  for (std::size_t c = 0; c < p.contacts.size(); ++c) EXPECT_EQ(p.contacts[c].history, q.contacts[c].history);
}

/// Expects that results do not depend on the skin of the neighbour lists, or on the number of parts in which the motion
/// is computed: they must be identical bit for bit.
template <int Dim>
void expect_no_trace_of_lists() {
  const Packing<Dim> gas = agitated_gas<Dim>(200, cohesive_law());
  const double dt = time_step_of(gas, RelaxationOptions{}.time_step);
  const Packing<Dim> tight = after(gas, {dt, 1e-3}, {600});
  ASSERT_GT(tight.contacts.size(), 50u);
  expect_same_bits(tight, after(gas, {dt, 0.3}, {600}));
  expect_same_bits(tight, after(gas, {dt, 0.05}, {100, 250, 250}));
}

template <int Dim>
void expect_no_trace_of_threads() {
  const Packing<Dim> gas = agitated_gas<Dim>(300, cohesive_law());
  const double dt = time_step_of(gas, RelaxationOptions{}.time_step);
  const Packing<Dim> one = after(gas, {dt, 0.05, 1}, {600});
  const Packing<Dim> two = after(gas, {dt, 0.05, 2}, {600});
  // The second thread of the team still exists after its work, so it can be counted.
  const auto tasks = std::filesystem::directory_iterator("/proc/self/task");
  EXPECT_GE(std::distance(begin(tasks), end(tasks)), 2);
  expect_same_bits(one, two);
}

/// Expects that results do not depend on which rows of forces are kept in memory. One thread overwrites earlier rows
/// with later rows; several threads keep the rows that they share.
template <int Dim>
void expect_no_trace_of_kept_rows(const Packing<Dim>& gas) {
  const double dt = time_step_of(gas, RelaxationOptions{}.time_step);
  const Packing<Dim> one = after(gas, {dt, 0.05, 1}, {200});
  ASSERT_GT(one.contacts.size(), 500u);
  expect_same_bits(one, after(gas, {dt, 0.05, 2}, {200}));
}

/// Expects that all instruction sets give identical results bit for bit, for laws with and without friction and rolling
/// resistance.
/// @param n_contacts  lower limit of the number of contacts at the end
template <int Dim>
void expect_no_trace_of_instructions(std::size_t n_contacts) {
  Law frictionless = cohesive_law();
  frictionless += test::without("friction");
  frictionless += test::without("rolling");
  Law sliding = cohesive_law();
  sliding += test::without("rolling");
  for (const Law& law : {cohesive_law(), sliding, frictionless}) {
    const Packing<Dim> gas = agitated_gas<Dim>(150, law);
    const double dt = time_step_of(gas, RelaxationOptions{}.time_step);
    const Packing<Dim> portable = after(gas, {dt, 0.05, 1, InstructionSet::portable}, {600});
    ASSERT_GT(portable.contacts.size(), n_contacts);
    for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512})
      if (supported(set)) expect_same_bits(portable, after(gas, {dt, 0.05, 1, set}, {600}));
  }
}

}  // namespace floc::test
