#include "floc/assembly/gas.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "floc/assembly/aggregation.h"
#include "floc/base/error.h"
#include "floc/neighbors/pairs.h"
#include "support/dynamics.h"

namespace floc {
namespace {

TEST(Gas, HasTheSolidFractionAskedForAndNoOverlap) {
  for (const double phi : {0.1, 0.36, 0.6}) {
    const Packing<2> gas = test::gas_of(200, test::cohesive_law(), phi);
    EXPECT_NEAR(solid_fraction(gas), phi, 1e-12);
    EXPECT_TRUE(find_pairs(gas.cell, gas.grains, 0.0).empty()) << phi;
  }
}

TEST(Gas, LargestGrainIsTheUnitOfLength) {
  const Packing<2> gas = test::gas_of(50, test::cohesive_law(), 0.3);
  const auto [low, high] = std::minmax_element(gas.grains.radius.begin(), gas.grains.radius.end());
  EXPECT_DOUBLE_EQ(*low, 0.25);
  EXPECT_DOUBLE_EQ(*high, 0.5);
  EXPECT_DOUBLE_EQ(*std::max_element(gas.grains.mass.begin(), gas.grains.mass.end()), 1.0);
}

TEST(Gas, IsNotALattice) {
  // In a hard-disk fluid, the gaps between neighbours range from zero upwards. On a lattice all gaps would be
  // equal.
  const Packing<2> gas = test::gas_of(400, test::cohesive_law(), 0.36);
  const auto near = [&](double gap) { return find_pairs(gas.cell, gas.grains, gap).size(); };
  EXPECT_GT(near(0.02), 20u);
  EXPECT_GT(near(0.2), 2 * near(0.05));
}

template <int Dim>
Packing<Dim> gas_of_kind(GasKind kind, int count, double solid_fraction, const BoxOptions* box = nullptr) {
  GrainOptions grains;
  grains.count = count;
  grains.diameter.min = 0.7;
  grains.diameter.max = 1.0;
  RandomStream random(1, 1);
  if (box) return make_boxed_gas<Dim>(grains, test::cohesive_law(), *box, solid_fraction, random, kind);
  return make_gas<Dim>(grains, test::cohesive_law(), solid_fraction, random, kind);
}

TEST(Gas, OfSequentialAdditionNearlyTouchesInMorePlacesThanOneInEquilibrium) {
  const auto near = [](GasKind kind) {
    const Packing<3> gas = gas_of_kind<3>(kind, 800, 0.37);
    EXPECT_NEAR(solid_fraction(gas), 0.37, 1e-12);
    EXPECT_TRUE(find_pairs(gas.cell, gas.grains, 0.0).empty());
    return find_pairs(gas.cell, gas.grains, 2e-3).size();
  };
  EXPECT_GT(near(GasKind::sequential_addition), 5 * near(GasKind::equilibrated));
}

TEST(Gas, OfSequentialAdditionKeepsClearOfWalls) {
  BoxOptions box;
  box.boundary[1] = BoxSide::periodic;
  const Packing<2> gas = gas_of_kind<2>(GasKind::sequential_addition, 300, 0.5, &box);
  EXPECT_TRUE(find_pairs(gas.cell, gas.grains, 0.0).empty());
  for (int i = 0; i < gas.grains.size(); ++i) {
    EXPECT_GE(gas.grains.position[i][0], gas.grains.radius[i]);
    EXPECT_LE(gas.grains.position[i][0], gas.cell.matrix(0, 0) - gas.grains.radius[i]);
  }
}

TEST(Gas, OfSequentialAdditionTooDenseToPartIsRefused) {
  EXPECT_THROW((void)gas_of_kind<2>(GasKind::sequential_addition, 50, 0.95), InputError);
}

TEST(Gas, OfImpossibleDensityIsRefused) {
  EXPECT_THROW((void)test::gas_of(50, test::cohesive_law(), 0.95), InputError);
}

TEST(Gas, SeedDecidesEverything) {
  EXPECT_EQ(test::gas_of(50, test::cohesive_law(), 0.3, 9).grains.position,
            test::gas_of(50, test::cohesive_law(), 0.3, 9).grains.position);
  EXPECT_NE(test::gas_of(50, test::cohesive_law(), 0.3, 9).grains.position,
            test::gas_of(50, test::cohesive_law(), 0.3, 10).grains.position);
}

TEST(Agitation, HasTheSpeedAskedForAndNoMomentum) {
  Packing<2> gas = test::gas_of(100, test::cohesive_law(), 0.3);
  RandomStream random(1, 2);
  agitate(gas, 0.3, random);
  Vec<2> momentum = Vec<2>::Zero();
  double squares = 0.0;
  for (int i = 0; i < gas.grains.size(); ++i) {
    momentum += gas.grains.mass[i] * gas.grains.velocity[i];
    squares += gas.grains.velocity[i].squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / gas.grains.size()), 0.3, 1e-12);
  EXPECT_LT(momentum.norm(), 1e-12);
}

TEST(Aggregation, CountsClustersThroughContactsAndTails) {
  Packing<2> four;
  four.grains = Grains<2>::with_size(4);
  EXPECT_EQ(count_clusters(four), 4);
  Contact<2> touching, distant;
  touching.i = 0, touching.j = 2;
  distant.i = 2, distant.j = 3, distant.distant = true;
  four.contacts = {touching, distant};
  EXPECT_EQ(count_clusters(four), 2);
}

}  // namespace
}  // namespace floc
