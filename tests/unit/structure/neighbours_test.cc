#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/neighbors/pairs.h"
#include "floc/network/rattlers.h"
#include "floc/packing/tile.h"
#include "floc/structure/coordination.h"
#include "floc/structure/gap_coordination.h"
#include "floc/structure/pair_correlation.h"
#include "floc/structure/pushed_rattlers.h"
#include "support/crystals.h"
#include "support/lattices.h"

namespace floc::test {
namespace {

using testing::ElementsAre;

TEST(PairCorrelation, OfALatticeIsItsShellsBeyondTheCellToo) {
  // There is one disk per cell, so every pair consists of images. The shells are at 1 (4 neighbours), sqrt 2
  // (4), 2 (4) and sqrt 5 (8).
  const Packing<2> packing = square_frames(2, 1.0, elastic_law(1.0, 0.0, 0.0));
  const PairCorrelation found = pair_correlation(packing, 2.5, 25);
  std::vector<double> neighbours(25, 0.0);
  for (int b = 0; b < 25; ++b) {
    neighbours[b] = 2.0 * static_cast<double>(found.n_pairs[b]);
    const double ring = std::numbers::pi * 0.01 * (2 * b + 1);
    EXPECT_NEAR(found.g[b] * ring, neighbours[b], 1e-12);
  }
  EXPECT_THAT(neighbours,
              ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, 0, 4, 0, 8, 0, 0));
  const PairCorrelation larger = pair_correlation(tiled<2>(packing, {3, 2}), 2.5, 25);
  for (int b = 0; b < 25; ++b) EXPECT_NEAR(larger.g[b], found.g[b], 1e-12);
}

TEST(PairCorrelation, OfIndependentGrainsIsOne) {
  const Packing<3> packing = random_packing<3>(3000, 4, elastic_law(1.0, 0.0, 0.0));
  const PairCorrelation found = pair_correlation(packing, 2.0, 2);
  for (int b = 0; b < 2; ++b)
    EXPECT_NEAR(found.g[b], 1.0, 4.0 / std::sqrt(static_cast<double>(found.n_pairs[b]))) << b;
}

TEST(PairCorrelation, ReachesAsFarAsItCanCount) {
  // Centres closer than the circumscribed spheres of grains with corners may be: 2500 neighbours within the reach.
  const Packing<2> packing = tiled<2>(square_frames(2, 0.25, elastic_law(1.0, 0.0, 0.0)), {20, 20});
  const PairCorrelation found = pair_correlation(packing, 7.0, 1);
  EXPECT_NEAR(found.g[0], 1.0, 0.01);
}

TEST(PairCorrelation, BetweenWallsIsThatOfGrainsAwayFromThem) {
  // A square lattice of 6 x 8 disks between two walls. Only rows at a distance of at least 2.5 from both walls
  // have complete shells of neighbours.
  Packing<2> packing = tiled<2>(square_frames(2, 1.0, elastic_law(1.0, 0.0, 0.0)), {6, 8});
  for (Vec<2>& x : packing.grains.position) x[1] += 0.5;
  packing.walls = {{1, -1, 0.0}, {1, 1, 8.0}};
  const PairCorrelation found = pair_correlation(packing, 2.5, 25);
  // The disks in four rows, at 2.5, 3.5, 4.5 and 5.5, count as centres: 24 grains. The shells around each centre
  // contain 4, 4, 4 and 8 neighbours. The density is 24 grains in an area of 6 x 3.
  const std::vector<std::pair<int, int>> shells = {{10, 4}, {14, 4}, {20, 4}, {22, 8}};
  for (const auto& [b, n] : shells) {
    EXPECT_EQ(found.n_pairs[b], 24 * n) << b;
    const double ring = std::numbers::pi * 0.01 * (2 * b + 1);
    EXPECT_NEAR(found.g[b], n / (24.0 / 18.0 * ring), 1e-12) << b;
  }
  packing.walls[1].position = 4.0;  // no grain is far enough from both walls
  EXPECT_TRUE(std::isnan(pair_correlation(packing, 2.5, 25).g[10]));
}

TEST(GapCoordination, CountsPairsUpToEachGap) {
  // Disks of diameter 0.9 on a square lattice have 4 neighbours at a gap of 0.1, 4 at sqrt 2 - 0.9 and 4 at
  // 1.1.
  Packing<2> packing = square_frames(2, 1.0, elastic_law(1.0, 0.0, 0.0));
  packing.grains.radius[0] = 0.45;
  const std::vector<double> z = gap_coordination(packing, {0.0, 0.0999, 0.1001, 0.5, 0.52, 1.2});
  EXPECT_THAT(z, ElementsAre(0, 0, 4, 4, 8, 12));
}

TEST(GapCoordination, WithoutAGapIsThatOfContacts) {
  const Packing<2> packing = random_packing<2>(60, 9, elastic_law(1.0, 0.0, 0.0));
  EXPECT_NEAR(gap_coordination(packing, {0.0, 1.0})[0], coordination(packing, 0.0).z, 1e-12);
}

TEST(Neighbours, OfCubicCrystalsAreTheirShells) {
  // For each crystal: the distance of each shell divided by the distance of the first shell, and the number of spheres
  // in the shell.
  const std::vector<std::vector<std::pair<double, int>>> shells = {
      {{1.0, 6}, {std::sqrt(2.0), 12}, {std::sqrt(3.0), 8}, {2.0, 6}},
      {{1.0, 8}, {std::sqrt(4.0 / 3.0), 6}, {std::sqrt(8.0 / 3.0), 12}, {std::sqrt(11.0 / 3.0), 24}},
      {{1.0, 12}, {std::sqrt(2.0), 6}, {std::sqrt(3.0), 24}, {2.0, 12}}};
  for (int k = 0; k < 3; ++k) {
    const CubicCrystal crystal = cubic_crystals()[k];
    const Packing<3> packing = crystal_of(crystal, 1.0, 0.9, elastic_law(1.0, 0.0, 0.0));
    const int n_bins = 400;
    const PairCorrelation found = pair_correlation(packing, 2.05, n_bins);
    int within = 0;
    for (const auto& [distance, n] : shells[k]) {
      const int bin = static_cast<int>(distance / found.width + 1e-9);
      EXPECT_EQ(2.0 * static_cast<double>(found.n_pairs[bin]) / packing.grains.size(), n)
          << crystal.name << distance;
      const double r = bin * found.width,
                   shell = 4.0 / 3.0 * std::numbers::pi * (std::pow(r + found.width, 3) - std::pow(r, 3));
      EXPECT_NEAR(found.g[bin] * shell / crystal.volume, n, 1e-9) << crystal.name << distance;
      within += n;
      EXPECT_EQ(gap_coordination(packing, {distance - 0.9 + 1e-9})[0], within) << crystal.name << distance;
    }
  }
}

/// Returns the smallest gap of grain i to other grains, and the number of grains at this gap (within 1e-9).
template <int Dim>
std::pair<double, int> touched_by(const Packing<Dim>& packing, int i) {
  double least = 1e9;
  int n = 0;
  for (const auto& pair : find_pairs(packing.cell, packing.grains, 0.3)) {
    if (pair.i != i && pair.j != i) continue;
    const auto& g = packing.grains;
    const Vec<Dim> r = g.position[pair.j] + packing.cell.shift(pair.image) - g.position[pair.i];
    const double gap = r.norm() - g.radius[pair.i] - g.radius[pair.j];
    least = std::min(least, gap);
    n += gap < 1e-9;
  }
  return {least, n};
}

TEST(PushedRattlers, OfDisksEndOnTwoGrains) {
  for (const Vec<2>& x : {Vec<2>(2.0, 2.0), Vec<2>(1.7, 2.6), Vec<2>(3.05, 2.9), Vec<2>(1.2, 1.3)}) {
    Packing<2> packing = square_frames(5, 1.0, elastic_law(1.0, 0.0, 0.0));
    packing.grains.position.push_back(x);
    packing.grains.radius.push_back(0.4);
    find_contacts(packing);
    const std::vector<bool> rattler = find_rattlers(packing, 0.0);
    ASSERT_TRUE(rattler.back());
    const Packing<2> pushed = with_pushed_rattlers(packing, rattler);
    const int last = packing.grains.size() - 1;
    for (int i = 0; i < last; ++i) EXPECT_EQ(pushed.grains.position[i], packing.grains.position[i]);
    const auto [gap, n] = touched_by(pushed, last);
    EXPECT_EQ(n, 2) << x.transpose();
    EXPECT_GT(gap, -1e-12);
    EXPECT_NEAR(gap_coordination(pushed, {0.0, 1.0})[0],
                (2.0 * static_cast<double>(packing.contacts.size()) + 4.0) / (last + 1), 1e-12);
  }
}

TEST(PushedRattlers, OfSpheresEndOnThreeGrains) {
  // A cage of spheres around the centre of the cubic cell; the spheres lie on its faces, edges and corners.
  Packing<3> packing;
  packing.law = elastic_law(1.0, 0.0, 0.0);
  packing.cell.matrix = 3.0 * Mat<3>::Identity();
  packing.grains = Grains<3>::with_size(20);
  int n = 0;
  for (int k = 0; k < 27; ++k) {
    const Vec<3, int> at(k % 3, k / 3 % 3, k / 9);
    if (at.minCoeff() > 0) continue;
    packing.grains.position[n] = at.cast<double>();
    packing.grains.radius[n] = 0.51 + 0.003 * n;
    ++n;
  }
  packing.grains.position[n] = {1.4, 1.55, 1.62};
  packing.grains.radius[n] = 0.3;
  ASSERT_EQ(n, 19);
  find_contacts(packing);
  const Packing<3> pushed = with_pushed_rattlers(packing, find_rattlers(packing, 0.0));
  const auto [gap, n_touching] = touched_by(pushed, 19);
  EXPECT_EQ(n_touching, 3);
  EXPECT_GT(gap, -1e-12);
}

TEST(PushedRattlers, StayWhereNothingIsNear) {
  Packing<2> packing = square_frames(20, 1.0, elastic_law(1.0, 0.0, 0.0));
  packing.grains.position.emplace_back(9.0, 9.5);
  packing.grains.radius.push_back(0.4);
  find_contacts(packing);
  const Packing<2> pushed = with_pushed_rattlers(packing, find_rattlers(packing, 0.0));
  EXPECT_EQ(pushed.grains.position.back(), packing.grains.position.back());
}

}  // namespace
}  // namespace floc::test
