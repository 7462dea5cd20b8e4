#include "floc/structure/voronoi.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "floc/neighbors/pairs.h"
#include "floc/packing/tile.h"
#include "support/crystals.h"

namespace floc::test {
namespace {

/// Returns the number of voids of each radius; radii are rounded to 1e-6.
std::map<long, int> voids_by_radius(const VoronoiTessellation& found) {
  std::map<long, int> count;
  for (const VoidBall& ball : found.voids) ++count[std::lround(1e6 * ball.radius)];
  return count;
}

TEST(Voronoi, OfCubicCrystalsHasTheirCellsAndHoles) {
  // For each crystal: the radius of the holes divided by the radius of the spheres, and the number of holes per
  // sphere. The holes are cubic (sc), tetrahedral (bcc), and tetrahedral and octahedral (fcc).
  const std::vector<std::vector<std::pair<double, int>>> holes = {
      {{std::sqrt(3.0) - 1.0, 1}},
      {{std::sqrt(5.0 / 3.0) - 1.0, 6}},
      {{std::sqrt(1.5) - 1.0, 2}, {std::sqrt(2.0) - 1.0, 1}}};
  for (int k = 0; k < 3; ++k) {
    const CubicCrystal crystal = cubic_crystals()[k];
    for (const int n : {1, 2}) {
      const Packing<3> packing = tiled<3>(crystal_of(crystal, 1.0, 1.0, elastic_law(1.0, 0.0, 0.0)), {n, n, n});
      const VoronoiTessellation found = voronoi_tessellation(packing);
      for (int i = 0; i < packing.grains.size(); ++i) {
        EXPECT_NEAR(found.volume[i], crystal.volume, 1e-9) << crystal.name;
        EXPECT_NEAR(found.solid_fraction[i], std::numbers::pi / 6.0 / crystal.volume, 1e-9) << crystal.name;
      }
      std::map<long, int> expected;
      for (const auto& [radius, per_sphere] : holes[k])
        expected[std::lround(0.5e6 * radius)] = per_sphere * packing.grains.size();
      EXPECT_EQ(voids_by_radius(found), expected) << crystal.name << n;
    }
  }
}

TEST(Voronoi, OfAnyPackingFillsTheCell) {
  // The cells are skewed, with right-handed or left-handed lattice vectors. The spheres have many different sizes, and
  // the unit of length takes very different values.
  for (const unsigned seed : {1u, 2u, 3u})
    for (const double unit : {1.0, 1e-30, 1e12}) {
      Packing<3> packing = random_packing<3>(60, seed, elastic_law(1.0, 0.0, 0.0), 0.7);
      packing.cell.matrix.row(0).swap(packing.cell.matrix.row(seed % 3));
      packing.cell.matrix *= unit;
      for (Vec<3>& x : packing.grains.position) x *= unit;
      for (double& R : packing.grains.radius) R *= unit;
      const VoronoiTessellation found = voronoi_tessellation(packing);
      const double sum = std::accumulate(found.volume.begin(), found.volume.end(), 0.0);
      EXPECT_NEAR(sum / packing.cell.volume(), 1.0, 1e-9) << seed << " " << unit;
    }
}

/// Returns the distance of a position from the nearest surface, and the number of surfaces at this distance.
std::pair<double, int> nearest_surfaces(Packing<3> packing, const Vec<3>& place) {
  Grains<3>& g = packing.grains;
  const int last = g.size();
  g.position.push_back(place);
  g.radius.push_back(0.0);
  std::vector<double> gaps;
  for (const auto& pair : find_pairs(packing.cell, g, 2.0)) {
    if (pair.i != last && pair.j != last) continue;
    const Vec<3> r = g.position[pair.j] + packing.cell.shift(pair.image) - g.position[pair.i];
    if (pair.i != pair.j) gaps.push_back(r.norm() - g.radius[pair.i] - g.radius[pair.j]);
  }
  const double least = *std::min_element(gaps.begin(), gaps.end());
  const auto n = std::count_if(gaps.begin(), gaps.end(), [&](double gap) { return gap < least + 1e-8; });
  return {least, static_cast<int>(n)};
}

TEST(Voronoi, HasVoidBallsThatFourEqualSpheresTouch) {
  Packing<3> packing = random_packing<3>(80, 5, elastic_law(1.0, 0.0, 0.0), 0.8);
  packing.grains.radius.assign(packing.grains.radius.size(), 0.4);
  const VoronoiTessellation found = voronoi_tessellation(packing);
  EXPECT_GT(found.voids.size(), 200u);
  for (const VoidBall& ball : found.voids) {
    const auto [gap, n] = nearest_surfaces(packing, ball.centre);
    EXPECT_NEAR(gap, ball.radius, 1e-8);
    EXPECT_EQ(n, 4);
  }
}

TEST(Voronoi, HasVoidBallsUpToTheNearestOfUnequalSpheres) {
  const Packing<3> packing = random_packing<3>(80, 6, elastic_law(1.0, 0.0, 0.0), 0.8);
  const VoronoiTessellation found = voronoi_tessellation(packing);
  EXPECT_GT(found.voids.size(), 200u);
  for (const VoidBall& ball : found.voids)
    EXPECT_NEAR(nearest_surfaces(packing, ball.centre).first, ball.radius, 1e-12);
}

TEST(Voronoi, OfUnequalSpheresIsRadical) {
  // Two spheres of radii R and S at a distance d along z, in a cell of height 2 d. The plane between their cells is at
  // the distance d/2 + (R^2 - S^2)/(2 d) from the first centre.
  Packing<3> packing;
  packing.cell.matrix = Vec<3>(1.0, 1.0, 2.0).asDiagonal();
  packing.grains = Grains<3>::with_size(2);
  packing.grains.position[1][2] = 1.0;
  packing.grains.radius = {0.5, 0.3};
  const VoronoiTessellation found = voronoi_tessellation(packing);
  EXPECT_NEAR(found.volume[0], 1.0 + 0.16, 1e-9);
  EXPECT_NEAR(found.volume[1], 1.0 - 0.16, 1e-9);
}

}  // namespace
}  // namespace floc::test
