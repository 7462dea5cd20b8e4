#include "floc/assembly/vibration.h"

#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/neighbors/pairs.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"

namespace floc {
namespace {

Law hard() {
  Law law;
  law += test::linear(1.0);
  return law;
}

double kinetic_energy(const Packing<3>& packing) {
  double sum = 0.0;
  for (int i = 0; i < packing.grains.size(); ++i)
    sum += 0.5 * packing.grains.mass[i] * packing.grains.velocity[i].squaredNorm();
  return sum;
}

/// The grains have the masses 1 and 1/8, and collide across the cell boundary.
TEST(Vibration, TwoGrainsBounceAsElasticOnesDo) {
  Packing<3> pair;
  pair.law = hard();
  pair.cell.matrix *= 3.0;
  pair.grains = Grains<3>::with_size(2);
  pair.grains.position = {Vec<3>(2.9, 1.0, 1.0), Vec<3>(0.9, 1.0, 1.0)};
  pair.grains.velocity = {Vec<3>(1.0, 0.5, 0.0), Vec<3>(0.0, 0.5, 0.0)};
  pair.grains.radius = {0.5, 0.25};
  pair.grains.mass = {1.0, 0.125};
  collide(pair, 1.0);  // one collision, at t = 0.25: along x, the initial gap of 0.25 closes at the speed 1
  EXPECT_NEAR(pair.grains.position[0][0], 3.15, 1e-12);
  EXPECT_NEAR(pair.grains.position[1][1], 1.125, 1e-12);
  EXPECT_NEAR(pair.grains.velocity[0][0], 0.875 / 1.125, 1e-12);
  EXPECT_NEAR(pair.grains.velocity[1][0], 2.0 / 1.125, 1e-12);
  EXPECT_EQ(pair.grains.velocity[0][1], 0.5);
}

TEST(Vibration, CollisionsKeepEnergyAndMomentumAndGrainsApart) {
  Packing<3> gas = test::gas_of<3>(200, hard(), 0.45);
  RandomStream random(3, 1);
  agitate(gas, 1.0, random);
  const std::vector<Vec<3>> start = gas.grains.velocity;
  const double energy = kinetic_energy(gas);
  collide(gas, 40.0);
  EXPECT_NEAR(kinetic_energy(gas), energy, 1e-11 * energy);
  Vec<3> momentum = Vec<3>::Zero();
  int changed = 0;
  for (int i = 0; i < gas.grains.size(); ++i) {
    momentum += gas.grains.mass[i] * gas.grains.velocity[i];
    changed += gas.grains.velocity[i] != start[i];
  }
  EXPECT_LT(momentum.norm(), 1e-12);
  EXPECT_EQ(changed, gas.grains.size());
  EXPECT_TRUE(find_pairs(gas.cell, gas.grains, -1e-9).empty());
}

TEST(Vibration, EndsAtRestInADilatedCell) {
  Packing<3> gas = test::gas_of<3>(100, hard(), 0.45);
  const std::vector<Vec<3>> start = gas.grains.position;
  RandomStream random(3, 1);
  Packing<3> shaken = gas;
  vibrate(shaken, {1.005, 20.0}, random);
  EXPECT_EQ(shaken.cell.matrix, 1.005 * gas.cell.matrix);
  EXPECT_EQ(kinetic_energy(shaken), 0.0);
  EXPECT_GT((shaken.grains.position[0] - 1.005 * start[0]).norm(), 1e-3);
}

TEST(Vibration, OfGrainsThatStillOverlapIsRefused) {
  Packing<3> gas = test::gas_of<3>(50, hard(), 0.45);
  gas.grains.position[1] = gas.grains.position[0] + Vec<3>(0.1, 0.0, 0.0);
  RandomStream random(3, 1);
  EXPECT_THROW(vibrate(gas, {1.005, 20.0}, random), InputError);
}

}  // namespace
}  // namespace floc
