#include "floc/structure/phase_structure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/base/random.h"
#include "support/crystals.h"
#include "support/lattices.h"

namespace floc::test {
namespace {

using testing::ElementsAre;

/// Returns a square lattice of nx times ny disks, numbered along x first.
Packing<2> square(int nx, int ny) {
  std::vector<Vec<2>> places;
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) places.emplace_back(x, y);
  return disks(Vec<2>(nx, ny).asDiagonal().toDenseMatrix(), places, 1.0, elastic_law(1.0, 0.0, 0.0));
}

TEST(PhaseStructure, OfColumnsIsCountedByHand) {
  // Four columns and three rows. Three grains are under tension: two in the second column, and one more. One grain is
  // neutral, and all others are under pressure.
  const Packing<2> packing = square(4, 3);
  const std::vector<double> pressure = {1, -1, 1, 1,  //
                                        1, -1, 1, 1,  //
                                        1, 2,  0, -3};
  const PhaseStructure phases = phase_structure(contact_network(packing), packing.cell, pressure, {});
  EXPECT_THAT(phases.positive.cluster_sizes, ElementsAre(8));
  EXPECT_THAT(phases.negative.cluster_sizes, ElementsAre(2, 1));
  EXPECT_THAT(phases.positive.along, ElementsAre(false, true, false));
  EXPECT_EQ(phases.positive.n_directions, 1);
  EXPECT_THAT(phases.negative.along, ElementsAre(false, false, false));
  // Of the 24 bonds, four belong to the neutral grain. Each grain under tension has three bonds with grains
  // under pressure.
  EXPECT_EQ(phases.n_bonds, 20);
  EXPECT_DOUBLE_EQ(phases.like_share, 11.0 / 20.0);
  EXPECT_DOUBLE_EQ(phases.like_expected, (8.0 * 7.0 + 3.0 * 2.0) / (11.0 * 10.0));
  // One of the three grains under tension has no neighbour under tension. For each of the other two, one of the four
  // neighbours is under tension.
  EXPECT_EQ(phases.negative.by_share[0].n_grains, 1);
  EXPECT_DOUBLE_EQ(phases.negative.by_share[0].mean_size, 3.0);
  EXPECT_EQ(phases.negative.by_share[2].n_grains, 2);
  EXPECT_DOUBLE_EQ(phases.negative.by_share[2].mean_size, 1.0);
  EXPECT_DOUBLE_EQ(phases.negative.by_share[2].mean_error, 0.0);
}

TEST(PhaseStructure, ShuffledSignsHaveTheShareOfTheClosedForm) {
  const Packing<2> packing = square(20, 20);
  std::vector<double> pressure(400);
  for (int i = 0; i < 400; ++i) pressure[i] = i < 100 ? -1.0 : 1.0;  // five rows are under tension
  PhaseOptions options;
  options.n_shuffles = 200;
  const PhaseStructure phases = phase_structure(contact_network(packing), packing.cell, pressure, options);
  EXPECT_DOUBLE_EQ(phases.like_share, 760.0 / 800.0);
  EXPECT_DOUBLE_EQ(phases.like_expected, (300.0 * 299.0 + 100.0 * 99.0) / (400.0 * 399.0));
  // After the signs of the grains have been shuffled, the signs at different bonds are nearly independent. The standard
  // deviation is therefore that of 800 independent bonds.
  const double q = phases.like_expected;
  EXPECT_NEAR(phases.like_deviation, std::sqrt(q * (1 - q) / 800.0), 0.5 * std::sqrt(q * (1 - q) / 800.0));
  // Sites of the square lattice percolate if the fraction of occupied sites is above 0.593. The positive grains (three
  // quarters) therefore percolate, and the negative grains (one quarter) do not.
  EXPECT_GT(phases.positive.shuffled_percolates, 0.95);
  EXPECT_LT(phases.negative.shuffled_percolates, 0.01);
  EXPECT_GT(phases.positive.largest_shuffled, 250.0);
  EXPECT_THAT(phases.negative.along, ElementsAre(true, false, false));
  EXPECT_THAT(phases.positive.along, ElementsAre(true, false, false));
}

TEST(PhaseStructure, InThreeDimensionsAPlaneWindsAlongTwoLatticeVectors) {
  CubicCrystal crystal = simple_cubic();
  crystal.places.clear();
  crystal.side = 4.0;
  for (int z = 0; z < 4; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) crystal.places.emplace_back(x / 4.0, y / 4.0, z / 4.0);
  const Packing<3> packing = crystal_of(crystal, 0.99, 1.0, elastic_law(1.0, 0.0, 0.0));
  ASSERT_EQ(packing.contacts.size(), 192u);
  std::vector<double> pressure(64, 1.0);
  for (int k = 0; k < 16; ++k) pressure[k] = -1.0 - k;
  const PhaseStructure phases = phase_structure(contact_network(packing), packing.cell, pressure, {});
  EXPECT_THAT(phases.negative.along, ElementsAre(true, true, false));
  EXPECT_EQ(phases.negative.n_directions, 2);
  EXPECT_DOUBLE_EQ(phases.like_share, 160.0 / 192.0);
  // Each grain in the plane of tension has six neighbours, four of which lie in the same plane.
  EXPECT_EQ(phases.negative.by_share[6].n_grains, 16);
  EXPECT_DOUBLE_EQ(phases.negative.by_share[6].mean_size, 8.5);
  EXPECT_NEAR(phases.negative.by_share[6].mean_error, std::sqrt(255.0 / 12.0 / 15.0), 1e-12);
}

TEST(PhaseStructure, WithoutGrainsOfASignIsEmpty) {
  const Packing<2> packing = square(3, 3);
  const PhaseStructure phases =
      phase_structure(contact_network(packing), packing.cell, std::vector<double>(9, 0.0), {});
  EXPECT_EQ(phases.n_bonds, 0);
  EXPECT_TRUE(phases.positive.cluster_sizes.empty());
  EXPECT_EQ(phases.like_expected, 0.0);
}

}  // namespace
}  // namespace floc::test
