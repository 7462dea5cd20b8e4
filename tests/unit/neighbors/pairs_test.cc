#include "floc/neighbors/pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "floc/base/error.h"
#include "floc/base/random.h"
#include "floc/neighbors/space_order.h"

namespace floc {
namespace {

template <int Dim>
Grains<Dim> random_grains(int n, const Cell<Dim>& cell, double largest_radius, std::uint64_t seed) {
  Grains<Dim> grains = Grains<Dim>::with_size(n);
  RandomStream random(seed, 1);
  for (int i = 0; i < n; ++i) {
    Vec<Dim> s;
    for (int a = 0; a < Dim; ++a) s[a] = random.uniform(-1.0, 2.0);  // also outside the cell
    grains.position[i] = cell.matrix.transpose() * s;
    grains.radius[i] = random.uniform(0.3, 1.0) * largest_radius;
  }
  return grains;
}

/// Finds all pairs by testing all periodic images up to `reach` cells away. This method is slow and independent of the
/// tested code.
template <int Dim>
std::vector<NeighborPair<Dim>> by_brute_force(const Cell<Dim>& cell, const Grains<Dim>& grains, double gap,
                                              int reach) {
  std::vector<NeighborPair<Dim>> found;
  const int per_axis = 2 * reach + 1;
  const int n_images = static_cast<int>(std::pow(per_axis, Dim));
  for (int i = 0; i < grains.size(); ++i)
    for (int j = i; j < grains.size(); ++j)
      for (int code = 0; code < n_images; ++code) {
        Vec<Dim, int> image;
        for (int a = Dim - 1, rest = code; a >= 0; --a, rest /= per_axis) image[a] = rest % per_axis - reach;
        // A grain and its image form the same pair twice, with opposite images. Only the image whose code is in
        // the upper half counts.
        if (i == j && code <= n_images / 2) continue;
        const Vec<Dim> r = grains.position[j] + cell.shift(image) - grains.position[i];
        if (r.norm() < grains.radius[i] + grains.radius[j] + gap) found.push_back({i, j, image});
      }
  return found;
}

/// Returns grains with radii from largest_radius/ratio to largest_radius, evenly distributed in ln r, so that every
/// level of the search has grains.
template <int Dim>
Grains<Dim> grains_of_sizes(int n, const Cell<Dim>& cell, double largest_radius, double ratio) {
  Grains<Dim> grains = random_grains(n, cell, largest_radius, 7);
  for (int i = 0; i < n; ++i)
    grains.radius[i] = largest_radius * std::pow(ratio, -static_cast<double>(i * 37 % n) / (n - 1));
  return grains;
}

template <int Dim>
void expect_all_found_whatever_the_sizes(const Cell<Dim>& cell, int n, double largest_radius) {
  for (const double ratio : {3.9, 4.1, 30.0, 1e4})
    for (const double gap : {0.0, 1e-3, 0.2}) {
      const Grains<Dim> grains = grains_of_sizes(n, cell, largest_radius, ratio);
      const auto expected = by_brute_force(cell, grains, gap, 5);
      ASSERT_FALSE(expected.empty());
      EXPECT_EQ(find_pairs(cell, grains, gap), expected) << "ratio " << ratio << ", gap " << gap;
    }
}

template <int Dim>
void expect_all_found(const Cell<Dim>& cell, int n, double largest_radius, double gap) {
  const Grains<Dim> grains = random_grains(n, cell, largest_radius, 11);
  const auto expected = by_brute_force(cell, grains, gap, 6);
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(find_pairs(cell, grains, gap), expected);
}

TEST(Pairs, AreThoseOfABruteForceSearch) {
  Cell<2> square;
  square.matrix << 10.0, 0.0, 0.0, 8.0;
  expect_all_found(square, 120, 0.5, 0.1);
  Cell<2> skewed;
  skewed.matrix << 9.0, 0.0, 4.0, 7.0;
  expect_all_found(skewed, 90, 0.5, 0.05);
  Cell<3> tilted;
  tilted.matrix << 5.0, 0.0, 0.0, 1.0, 4.0, 0.0, -0.5, 0.7, 6.0;
  expect_all_found(tilted, 80, 0.5, 0.1);
}

TEST(Pairs, OfASmallCellIncludeSeveralImagesAndTheGrainsOwn) {
  Cell<2> small;
  small.matrix << 1.1, 0.0, 0.2, 0.9;
  expect_all_found(small, 3, 0.6, 0.3);
  expect_all_found(small, 1, 0.6, 1.5);
}

TEST(Pairs, OfGrainsOfAllSizesAreThoseOfABruteForceSearch) {
  Cell<2> square;
  square.matrix << 10.0, 0.0, 0.0, 8.0;
  expect_all_found_whatever_the_sizes(square, 150, 1.0);
  Cell<2> skewed;
  skewed.matrix << 9.0, 0.0, 4.0, 7.0;
  expect_all_found_whatever_the_sizes(skewed, 120, 1.5);
  Cell<2> small;
  small.matrix << 1.1, 0.0, 0.2, 0.9;
  expect_all_found_whatever_the_sizes(small, 12, 0.6);
  Cell<3> tilted;
  tilted.matrix << 5.0, 0.0, 0.0, 1.0, 4.0, 0.0, -0.5, 0.7, 6.0;
  expect_all_found_whatever_the_sizes(tilted, 60, 1.0);
}

TEST(Pairs, OfPointsBesideAGrainAreFound) {
  Cell<2> cell;
  cell.matrix *= 10.0;
  Grains<2> grains = random_grains(40, cell, 1.0, 3);
  for (int i = 1; i < grains.size(); ++i) grains.radius[i] = 0.0;
  EXPECT_EQ(find_pairs(cell, grains, 0.0), by_brute_force(cell, grains, 0.0, 3));
}

TEST(Pairs, OfOneGrainAThousandTimesAsLargeAsManyAreFound) {
  // All small grains are within reach of the large one. A search with one grid for all sizes would test 3e9 pairs.
  constexpr int kSmall = 50000;
  Cell<2> cell;
  cell.matrix *= 2.0;
  Grains<2> grains = random_grains(kSmall + 1, cell, 1e-4, 5);
  grains.radius[kSmall] = 0.9;
  int near_large = 0, found = 0;
  for (int i = 0; i < kSmall; ++i) {
    Vec<2> r = grains.position[kSmall] - grains.position[i];
    for (int a = 0; a < 2; ++a) r[a] -= 2.0 * std::round(r[a] / 2.0);
    near_large += r.norm() < 0.9 + grains.radius[i];
  }
  const auto pairs = find_pairs(cell, grains, 0.0);
  for (const auto& pair : pairs) found += pair.j == kSmall;
  EXPECT_EQ(found, near_large);
  EXPECT_GT(near_large, kSmall / 2);
}

TEST(Pairs, OfACellThatIsTinyBesideItsGrainsAreRefused) {
  Grains<2> grains = Grains<2>::with_size(2);
  grains.radius = {1e4, 1.0};
  EXPECT_THAT(
      [&] { (void)find_pairs(Cell<2>{}, grains, 0.0); },
      testing::ThrowsMessage<InputError>(testing::HasSubstr("is so small compared with its largest grain")));
}

TEST(Pairs, OfNoGrainsAreNone) {
  EXPECT_TRUE(find_pairs(Cell<2>{}, Grains<2>{}, 0.1).empty());
}

TEST(Pairs, RefuseValuesThatAreNotFinite) {
  Cell<2> cell;
  Grains<2> grains = Grains<2>::with_size(1);
  grains.position[0][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)find_pairs(cell, grains, 0.1), InputError);
  cell.matrix.setZero();
  EXPECT_THROW((void)find_pairs(cell, Grains<2>::with_size(1), 0.1), InputError);
}

TEST(Pairs, OfMoreThanAThousandNeighboursAGrainAreRefused) {
  // A disk of radius 50 in a cell of side 1 touches all its images within a distance of 100. The number of pairs is pi
  // 100^2/2, about 15 700. The limit for this cell is 10 000 + 1000 pairs.
  Grains<2> grains = Grains<2>::with_size(1);
  grains.radius[0] = 50.0;
  EXPECT_THAT(
      [&] { (void)find_pairs(Cell<2>{}, grains, 0.0); },
      testing::ThrowsMessage<InputError>(testing::HasSubstr("that each has more than 1000 neighbours")));
}

TEST(SpaceOrder, IsAPermutationThatKeepsNeighboursClose) {
  Cell<2> cell;
  cell.matrix *= 32.0;
  const Grains<2> grains = random_grains(1000, cell, 0.5, 2);
  std::vector<int> order = space_order(cell, grains);
  double along = 0.0, unordered = 0.0;
  for (int k = 1; k < grains.size(); ++k) {
    along += (cell.wrapped(grains.position[order[k]]) - cell.wrapped(grains.position[order[k - 1]])).norm();
    unordered += (cell.wrapped(grains.position[k]) - cell.wrapped(grains.position[k - 1])).norm();
  }
  EXPECT_LT(along, 0.2 * unordered);
  std::sort(order.begin(), order.end());
  for (int k = 0; k < grains.size(); ++k) ASSERT_EQ(order[k], k);
}

TEST(SpaceOrder, OfManySpheresHasNeighboursWithinAFewLayers) {
  constexpr int kGrains = 12'000;
  constexpr double kSide = 24.0;
  Cell<3> cell;
  cell.matrix *= kSide;
  cell.matrix(1, 0) = 5.0;
  Grains<3> grains = random_grains(kGrains, cell, 0.5, 2);
  for (Vec<3>& x : grains.position) x = cell.wrapped(x);
  const std::vector<int> order = space_order(cell, grains);
  std::vector<int> place(order.size(), -1);
  for (int k = 0; k < kGrains; ++k) place[order[k]] = k;
  EXPECT_THAT(place, testing::Each(testing::Ge(0)));
  int furthest = 0, n_pairs = 0;
  for (const NeighborPair<3>& pair : find_pairs(cell, grains, 0.0)) {
    if (!pair.image.isZero()) continue;  // grains of pairs across the boundary are far apart in the order
    furthest = std::max(furthest, std::abs(place[pair.i] - place[pair.j]));
    ++n_pairs;
  }
  EXPECT_GT(n_pairs, kGrains / 4);
  EXPECT_LT(furthest, 3.0 / kSide * kGrains);
}

TEST(FindPairs, RefusesARadiusNearTheLargestNumberInWords) {
  Grains<2> grains = Grains<2>::with_size(2);
  grains.radius = {1e308, 0.5};
  grains.position[1] = Vec<2>(0.5, 0.5);
  EXPECT_THROW(find_pairs(Cell<2>{}, grains, 0.0), InputError);
}

}  // namespace
}  // namespace floc
