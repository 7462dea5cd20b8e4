#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "floc/structure/axis_profile.h"
#include "floc/structure/porosity_probe.h"
#include "support/lattices.h"

namespace floc::test {
namespace {

constexpr double kPi = std::numbers::pi;

Packing<3> one_sphere(const Vec<3>& place, double side) {
  Packing<3> packing;
  packing.cell.matrix *= side;
  packing.grains = Grains<3>::with_size(1);
  packing.grains.position[0] = place;
  packing.grains.radius[0] = 0.5;
  return packing;
}

/// Returns the fraction of random points inside grains, in a cube of half side h about the centre of the cell.
template <int Dim>
double share_of_points(const Packing<Dim>& packing, double h) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> uniform(-h, h);
  constexpr int kPoints = 100000;
  int inside = 0;
  for (int k = 0; k < kPoints; ++k) {
    Vec<Dim> x = packing.cell.matrix.transpose() * Vec<Dim>::Constant(0.5);
    for (int a = 0; a < Dim; ++a) x[a] += uniform(engine);
    for (int i = 0; i < packing.grains.size(); ++i)
      for (int image = 0; image < 25; ++image) {
        Vec<Dim, int> shift = Vec<Dim, int>::Zero();
        shift[0] = image % 5 - 2, shift[1] = image / 5 - 2;
        inside +=
            (packing.grains.position[i] + packing.cell.shift(shift) - x).norm() < packing.grains.radius[i];
      }
  }
  return static_cast<double>(inside) / kPoints;
}

TEST(PorosityProbe, OfASphereInTheMiddleIsASphereInACube) {
  const auto probes = porosity_probes(one_sphere(Vec<3>::Constant(1.0), 2.0), 8);
  ASSERT_EQ(probes.size(), 8u);
  // The first cube lies inside the sphere; cubes of half side 0.5 or more contain it.
  EXPECT_NEAR(probes[0].in_cube, 1.0, 1e-13);
  EXPECT_DOUBLE_EQ(probes[0].half_side, 1.0 / 16.0);
  EXPECT_NEAR(probes[3].in_cube, kPi / 6.0, 1e-13);
  EXPECT_NEAR(probes[7].in_cube, kPi / 6.0 / 8.0, 1e-13);
  EXPECT_NEAR(*probes[7].in_cell, kPi / 6.0 / 8.0, 1e-13);
}

TEST(PorosityProbe, OfASphereOnTheCornerIsSeenFromAllSides) {
  const auto probes = porosity_probes(one_sphere(Vec<3>(2.0, 0.0, 4.0), 2.0), 4);
  EXPECT_EQ(probes[1].in_cube, 0.0);
  EXPECT_NEAR(probes[3].in_cube, kPi / 6.0 / 8.0, 1e-13);
}

TEST(PorosityProbe, OfASkewedCellHasNoShrunkCell) {
  Packing<2> packing;
  packing.cell.matrix << 3.0, 0.0, 1.3, 2.5;
  packing.grains = Grains<2>::with_size(3);
  packing.grains.position = {{0.2, 0.1}, {1.9, 1.2}, {4.0, 2.2}};
  packing.grains.radius = {0.5, 0.7, 0.3};
  const auto probes = porosity_probes(packing, 3);
  EXPECT_FALSE(probes[2].in_cell);
  const double L = 2.5 * 3.0 / std::hypot(2.5, 1.3);
  // With 1e5 points the fraction has an error of 0.0016.
  for (const PorosityProbe& p : probes)
    EXPECT_NEAR(p.in_cube, share_of_points(packing, p.half_side * std::min(L, 2.5)), 0.007);
}

TEST(PorosityProbe, BetweenWallsHasNoImages) {
  Packing<3> packing = one_sphere(Vec<3>(0.5, 1.0, 1.0), 2.0);
  packing.walls = {{0, -1, 0.0}, {0, 1, 2.0}};
  EXPECT_NEAR(*porosity_probes(packing, 1)[0].in_cell, kPi / 6.0 / 8.0, 1e-13);
  // A cap of the height R/2 lies in the wall. This cap does not count, and it does not reappear at the opposite wall.
  packing.grains.position[0][0] = 0.25;
  const double cap = kPi * 0.25 * 0.25 * (1.5 - 0.25) / 3.0;
  EXPECT_NEAR(*porosity_probes(packing, 1)[0].in_cell, (kPi / 6.0 - cap) / 8.0, 1e-13);
}

TEST(AxisProfile, OfALayerIsCapsAndMeans) {
  Packing<3> packing = one_sphere(Vec<3>(1.0, 1.0, 0.1), 2.0);
  const auto slices = axis_profile(packing, 2, 4, {{7.0}});
  ASSERT_EQ(slices.size(), 4u);
  // The sphere extends from -0.4 to 0.6 along the last axis, across the cell boundary. The last slice contains a cap of
  // height 0.4, and the second slice a cap of height 0.1.
  const auto cap = [](double h) { return kPi * h * h * (1.5 - h) / 3.0; };
  EXPECT_NEAR(slices[3].solid_fraction, cap(0.4) / 2.0, 1e-14);
  EXPECT_NEAR(slices[1].solid_fraction, cap(0.1) / 2.0, 1e-14);
  EXPECT_NEAR(slices[0].solid_fraction, (kPi / 6.0 - cap(0.4) - cap(0.1)) / 2.0, 1e-14);
  EXPECT_EQ(slices[2].solid_fraction, 0.0);
  EXPECT_EQ(slices[0].n_grains, 1);
  EXPECT_DOUBLE_EQ(slices[0].mean[0], 7.0);
  EXPECT_TRUE(std::isnan(slices[1].mean[0]));
  EXPECT_DOUBLE_EQ(slices[1].low, 0.5);
}

TEST(AxisProfile, AddsUpToTheSolidFractionOfAnyCell) {
  const Packing<2> packing = honeycomb(1.0, elastic_law(1.0, 0.0, 0.0));
  for (const int axis : {0, 1}) {
    double sum = 0.0;
    for (const ProfileSlice& slice : axis_profile(packing, axis, 7, {})) sum += slice.solid_fraction / 7.0;
    EXPECT_NEAR(sum, solid_fraction(packing), 1e-14);
  }
}

}  // namespace
}  // namespace floc::test
