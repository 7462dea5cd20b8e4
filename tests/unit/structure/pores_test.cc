#include "floc/structure/pores.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "support/lattices.h"

namespace floc::test {
namespace {

using testing::SizeIs;
using testing::UnorderedElementsAre;

Packing<2> of_radius(Packing<2> packing, double R) {
  std::fill(packing.grains.radius.begin(), packing.grains.radius.end(), R);
  return packing;
}

/// Adds disks at rest to a packing and finds all contacts again.
void add_disks(Packing<2>& packing, const std::vector<Vec<2>>& places, const std::vector<double>& radii) {
  const Grains<2> old = packing.grains;
  packing.grains = Grains<2>::with_size(old.size() + static_cast<int>(places.size()));
  const auto join = [](auto& all, const auto& first, const auto& then) {
    std::copy(then.begin(), then.end(), std::copy(first.begin(), first.end(), all.begin()));
  };
  join(packing.grains.position, old.position, places);
  join(packing.grains.radius, old.radius, radii);
  packing.grains.mass.assign(packing.grains.size(), 1.0);
  find_contacts(packing);
}

/// Returns the squared radius of gyration of a square of side s from which a quarter disk of radius R is removed at
/// each corner.
double square_pore(double s, double R) {
  const double quarter = std::numbers::pi * R * R / 4.0;
  const double second =
      std::numbers::pi * R * R * R * R / 8.0 + quarter * s * s / 2.0 - 2.0 * R * R * R / 3.0 * s;
  return (s * s * s * s / 6.0 - 4.0 * second) / (s * s - 4.0 * quarter);
}

TEST(Pores, OfASquareLatticeAreExact) {
  const Pores found = find_pores(of_radius(square_frames(2, 1.0, elastic_law(1.0, 0.0, 0.0)), 0.5));
  ASSERT_THAT(found.pores, SizeIs(1));
  EXPECT_NEAR(found.pores[0].area, 1.0 - std::numbers::pi / 4.0, 1e-14);
  EXPECT_NEAR(found.pores[0].gyration_radius, std::sqrt(square_pore(1.0, 0.5)), 1e-13);
  EXPECT_NEAR(found.size, std::sqrt(square_pore(1.0, 0.5)), 1e-13);
  EXPECT_NEAR((found.pores[0].centre - Vec<2>(0.5, 0.5)).norm(), 0.0, 1e-13);
  EXPECT_FALSE(found.unbounded);
  EXPECT_EQ(found.failure_reason, "");
}

TEST(Pores, OfATriangularLatticeAreTwoOfAKind) {
  const Pores found = find_pores(of_radius(triangular(2.0, elastic_law(1.0, 0.0, 0.0)), 1.0));
  ASSERT_THAT(found.pores, SizeIs(2));
  // Three sectors of the disks, of 60 degrees each, are removed from a triangle of side 2. The second moment of the
  // triangle about its centre is side^2 area/12. The corner of each sector is at the distance 2/sqrt 3 from the centre.
  // The moments of a sector about its corner are shifted to the centre; its first moment towards the centre is 2 sin(30
  // deg) R^3/3.
  const double area = std::sqrt(3.0) - std::numbers::pi / 2.0;
  const double sector = std::numbers::pi / 6.0;
  const double second = sector / 2.0 + sector * 4.0 / 3.0 - 2.0 * (1.0 / 3.0) * 2.0 / std::sqrt(3.0);
  const double gyration2 = (4.0 * std::sqrt(3.0) / 12.0 - 3.0 * second) / area;
  for (const Pore& pore : found.pores) {
    EXPECT_NEAR(pore.area, area, 1e-13);
    EXPECT_NEAR(pore.gyration_radius, std::sqrt(gyration2), 1e-12);
    EXPECT_THAT(pore.grains, SizeIs(3));
  }
}

TEST(Pores, OfDifferentSizesCountByTheirArea) {
  // A frame of 5 disks per side has one large pore. The cell contains two such frames. One of them has a disk in its
  // middle.
  const Packing<2> packing = square_frames(5, 1.0, elastic_law(1.0, 0.0, 0.0));
  const double large = find_pores(of_radius(packing, 0.5)).pores.at(0).gyration_radius;
  Packing<2> two = packing;
  two.cell.matrix(0, 0) *= 2.0;
  std::vector<Vec<2>> places;
  for (const Vec<2>& x : packing.grains.position) places.push_back(x + Vec<2>(4.0, 0.0));
  places.emplace_back(2.0, 2.0);
  std::vector<double> radii(packing.grains.radius);
  radii.push_back(0.75);
  add_disks(two, places, radii);
  two = of_radius(two, 0.5);
  two.grains.radius.back() = 0.75;
  const Pores found = find_pores(two);
  ASSERT_THAT(found.pores, SizeIs(2));
  const double disk = std::numbers::pi * 0.75 * 0.75;
  const double open = 16.0 - 7.0 * std::numbers::pi / 4.0;
  const double second = open * large * large - disk * 0.75 * 0.75 / 2.0;
  EXPECT_THAT((std::vector<double>{found.pores[0].area, found.pores[1].area}),
              UnorderedElementsAre(testing::DoubleNear(open, 1e-12), testing::DoubleNear(open - disk, 1e-12)));
  const double sum = open * large * large + second;
  EXPECT_NEAR(found.size, std::sqrt(sum / (2.0 * open - disk)), 1e-12);
  EXPECT_FALSE(found.unbounded);
}

TEST(Pores, HoldIslandsAndDeadEnds) {
  // A frame in which there are a side branch of one disk, a single disk and a pair of disks.
  Packing<2> packing = square_frames(9, 1.0, elastic_law(1.0, 0.0, 0.0));
  add_disks(packing, {{3.0, 1.0}, {6.0, 5.5}, {2.3, 4.0}, {2.3, 5.0}}, std::vector<double>(4, 0.51));
  packing = of_radius(packing, 0.5);
  const Pores found = find_pores(packing);
  ASSERT_THAT(found.pores, SizeIs(1));
  EXPECT_NEAR(found.pores[0].area, packing.cell.volume() * (1.0 - solid_fraction(packing)), 1e-11);
  // The expected radius of gyration is computed from the pore of the empty frame. The moments of the disks, shifted by
  // the parallel axis theorem, are subtracted from those of this pore.
  const Pores bare = find_pores(of_radius(square_frames(9, 1.0, elastic_law(1.0, 0.0, 0.0)), 0.5));
  const double disk = std::numbers::pi / 4.0;
  double area = bare.pores[0].area, second = area * std::pow(bare.pores[0].gyration_radius, 2);
  Vec<2> first = Vec<2>::Zero();
  for (int i = packing.grains.size() - 4; i < packing.grains.size(); ++i) {
    const Vec<2> x = packing.grains.position[i] - Vec<2>(4.0, 4.0);
    area -= disk;
    first -= disk * x;
    second -= disk * (x.squaredNorm() + 0.125);
  }
  EXPECT_NEAR(found.pores[0].gyration_radius, std::sqrt(second / area - (first / area).squaredNorm()), 1e-11);
}

/// Returns a packing of disks that do not overlap. Its contacts are the edges of a distorted triangular net from which
/// some edges were removed.
Packing<2> net(int side, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Packing<2> packing;
  packing.cell.matrix << side, 0.0, 0.5 * side, std::sqrt(0.75) * side;
  packing.grains = Grains<2>::with_size(side * side);
  const Mat<2> step = packing.cell.matrix.transpose() / side;
  for (int i = 0; i < side * side; ++i) {
    packing.grains.position[i] =
        step * Vec<2>(i % side + 0.1 * uniform(engine), i / side + 0.1 * uniform(engine));
    packing.grains.radius[i] = 0.2 + 0.2 * uniform(engine);
  }
  const auto at = [side](int a, int b) { return (b % side) * side + a % side; };
  for (int b = 0; b < side; ++b)
    for (int a = 0; a < side; ++a)
      for (const Vec<2, int>& d : {Vec<2, int>(1, 0), Vec<2, int>(0, 1), Vec<2, int>(-1, 1)}) {
        if (uniform(engine) < 0.25) continue;
        Contact<2> c;
        const int to1 = a + d[0] + side, to2 = b + d[1] + side;
        c.i = at(a, b);
        c.j = at(to1, to2);
        c.image = {to1 / side - 1, to2 / side - 1};
        packing.contacts.push_back(c);
      }
  return packing;
}

TEST(Pores, FillWhatGrainsLeave) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Packing<2> packing = net(8, seed);
    const Pores found = find_pores(packing);
    ASSERT_EQ(found.failure_reason, "");
    EXPECT_FALSE(found.unbounded);
    EXPECT_NEAR(found.total_area, packing.cell.volume() * (1.0 - solid_fraction(packing)), 1e-11);
    double second = 0.0;
    for (const Pore& p : found.pores) second += p.area * p.gyration_radius * p.gyration_radius;
    EXPECT_NEAR(found.size, std::sqrt(second / found.total_area), 1e-12);
  }
}

TEST(Pores, ThatWindAroundTheCellHaveNoSize) {
  const Pores chain = find_pores(of_radius(chain_across(4, 1.0, 3.0, elastic_law(1.0, 0.0, 0.0)), 0.5));
  EXPECT_TRUE(chain.unbounded);
  EXPECT_THAT(chain.pores, SizeIs(0));
  EXPECT_EQ(chain.size, 0.0);
  Packing<2> ring =
      disks(10.0 * Mat<2>::Identity(), {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, 1.0, elastic_law(1.0, 0.0, 0.0));
  const Pores island = find_pores(of_radius(ring, 0.5));
  EXPECT_TRUE(island.unbounded);
  ASSERT_THAT(island.pores, SizeIs(1));
  EXPECT_NEAR(island.size, std::sqrt(square_pore(1.0, 0.5)), 1e-13);
}

TEST(Pores, OfContactsThatCrossAreRefused) {
  // The four disks at the corners of a square all touch each other.
  Packing<2> packing = square_frames(2, 1.0, elastic_law(1.0, 0.0, 0.0));
  packing.grains.radius[0] = 0.8;
  find_contacts(packing);
  EXPECT_NE(find_pores(packing).failure_reason, "");
}

}  // namespace
}  // namespace floc::test
