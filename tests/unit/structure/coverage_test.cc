#include "floc/structure/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "support/network_packings.h"

namespace floc::test {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<Vec<2>> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(DiskPolygonOverlap, IsTheSmallerOneWhereOneHoldsTheOther) {
  EXPECT_NEAR(disk_polygon_overlap(0.5, rectangle(-1, -2, 3, 1)), 0.25 * kPi, 1e-14);
  EXPECT_NEAR(disk_polygon_overlap(5.0, rectangle(-1, -2, 3, 1)), 12.0, 1e-13);
  EXPECT_NEAR(disk_polygon_overlap(0.5, rectangle(0.6, -2, 3, 1)), 0.0, 1e-14);
}

TEST(DiskPolygonOverlap, OfAHalfPlaneIsASegment) {
  for (const double x : {-0.9, -0.3, 0.0, 0.45, 0.99}) {
    const double segment = std::acos(x) - x * std::sqrt(1.0 - x * x);
    EXPECT_NEAR(disk_polygon_overlap(1.0, rectangle(x, -10, 10, 10)), segment, 1e-13) << x;
  }
}

TEST(DiskPolygonOverlap, OfAWedgeAtTheCentreIsASector) {
  const std::vector<Vec<2>> wedge = {{0, 0}, {10, 0}, {10, 10 * std::sqrt(3.0)}};
  EXPECT_NEAR(disk_polygon_overlap(2.0, wedge), 2.0 * kPi / 3.0, 1e-13);
}

TEST(CoverageMap, HoldsTheSolidFractionExactlyInSkewedCells) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    Packing<2> packing = random_packing<2>(20, seed, elastic_law(1.0, 0.0, 0.0));
    if (seed == 2) packing.cell.matrix.row(0) *= -1.0;  // makes the lattice vectors left-handed
    const CoverageMap map = coverage_map(packing, {17, 12});
    const double mean = std::accumulate(map.share.begin(), map.share.end(), 0.0) / (17.0 * 12.0);
    EXPECT_NEAR(mean, solid_fraction(packing), 1e-13);
  }
}

TEST(CoverageMap, PutsADiskWhereItIs) {
  Packing<2> packing;
  packing.cell.matrix = 4.0 * Mat<2>::Identity();
  packing.grains = Grains<2>::with_size(1);
  packing.grains.position[0] = {1.5, 0.0};
  packing.grains.radius[0] = 0.5;
  const CoverageMap map = coverage_map(packing, {4, 4});
  for (int k1 = 0; k1 < 4; ++k1)
    for (int k2 = 0; k2 < 4; ++k2)
      EXPECT_NEAR(map(k1, k2), k1 == 1 && (k2 == 0 || k2 == 3) ? kPi / 8.0 : 0.0, 1e-14) << k1 << ' ' << k2;
}

}  // namespace
}  // namespace floc::test
