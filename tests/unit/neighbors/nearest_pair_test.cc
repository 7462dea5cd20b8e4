#include "floc/neighbors/nearest_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>

#include "floc/packing/locate.h"
#include "floc/shape/generators.h"
#include "support/few_grains.h"
#include "support/rigid_states.h"

namespace floc {
namespace {

/// Returns long boxes, 1 x 1/4 in 2D and 1 x 1/4 x 1/4 in 3D, with random rotations on a square or cubic lattice.
template <int Dim>
Packing<Dim> long_boxes(unsigned seed) {
  constexpr int kSide = 3;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vec<Dim>> places;
  for (int n = 0; n < (Dim == 2 ? 9 : 27); ++n) {
    Vec<Dim> x;
    for (int a = 0, rest = n; a < Dim; ++a, rest /= kSide) x[a] = 1.2 * (rest % kSide) + 0.05 * unit(random);
    places.push_back(x);
  }
  Packing<Dim> packing = test::unit_grains<Dim>(places, 1.2 * kSide, test::rigid_law(0.5));
  Grains<Dim>& grains = packing.grains;
  Vec<Dim> sides = Vec<Dim>::Constant(0.25);
  sides[0] = 1.0;
  grains.shapes = std::make_shared<const std::vector<Shape<Dim>>>(1, box<Dim>(sides, 0.0));
  grains.shape.assign(places.size(), 0);
  grains.scale.assign(places.size(), 0.5 / grains.shapes->front().outer_radius);
  for (auto& orientation : grains.orientation) {
    if constexpr (Dim == 2)
      orientation = 3.0 * unit(random);
    else
      orientation = Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized();
  }
  return packing;
}

/// Returns the smallest gap of all pairs of grains and of all their nearest periodic images.
template <int Dim>
double smallest_gap(const Packing<Dim>& packing) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < packing.grains.size(); ++i)
    for (int j = i + 1; j < packing.grains.size(); ++j)
      for (int n = 0; n < (Dim == 2 ? 9 : 27); ++n) {
        Contact<Dim> c;
        c.i = i, c.j = j;
        for (int a = 0, rest = n; a < Dim; ++a, rest /= 3) c.image[a] = rest % 3 - 1;
        const Manifold<Dim> found = manifold_of(packing, c, branch(packing, c), 1.0);
        if (found.n() > 0) smallest = std::min(smallest, found.least_gap());
      }
  return smallest;
}

template <int Dim>
void expect_smallest_gap() {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Packing<Dim> packing = long_boxes<Dim>(seed);
    const std::optional<NearestPair> found = nearest_pair(packing);
    ASSERT_TRUE(found) << seed;
    EXPECT_NEAR(found->gap, smallest_gap(packing), 1e-9) << seed;
  }
}

TEST(NearestPair, OfGrainsWithCornersHasTheSmallestGap) {
  expect_smallest_gap<2>();
  expect_smallest_gap<3>();
}

}  // namespace
}  // namespace floc
