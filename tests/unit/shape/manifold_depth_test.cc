#include <gtest/gtest.h>

#include "floc/shape/manifold.h"
#include "unit/shape/feature_distance.h"

namespace floc {
namespace {

using namespace test;

/// Number of compared pairs, and number of those pairs that agree up to rounding.
struct Counts {
  int compared = 0, exact = 0;
};

/// Compares the gap of a contact with `expected`, the distance or depth computed from all pairs of features.
template <int Dim>
void compare(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second, const FeatureGap& expected,
             Counts& counts) {
  const Manifold<Dim> contact = contact_manifold<Dim>(first, second, std::max(0.0, expected.gap) + 1e-3);
  ASSERT_GT(contact.n(), 0) << expected.gap;
  EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-14);
  const double inner = std::min(first.inner_radius(), second.inner_radius()), outer = second.outer_radius();
  const double error = std::abs(contact.least_gap() - expected.gap), rounding_error = 1e-14 * outer;
  // A contact may use the normal of a face although the common normal of an edge pair gives a separation that is larger
  // by up to a margin. For separate shapes, the chosen normal decides whether the shapes count as separate, so their
  // gap may have this error too.
  EXPECT_LT(error, 1.01e-4 * inner) << expected.gap;
  ++counts.compared;
  counts.exact += error < 4.0 * rounding_error ? 1 : 0;
  // The separation of the shapes along the contact normal must equal the smallest gap. If a rounded shape touches with
  // a face, the face normal may differ by 1e-3 radians from the line between the closest points.
  const double along = separation_along<Dim>(first, second, contact.normal);
  if (first.rounding() + second.rounding() == 0.0 || !expected.is_core_apart)
    EXPECT_NEAR(along, contact.least_gap(), 1e-6 * inner + 10.0 * rounding_error) << expected.gap;
  else
    EXPECT_NEAR(along, contact.least_gap(), 1.1e-3 * std::min(first.outer_radius(), outer)) << expected.gap;
}

/// Tests 500 pairs of shapes with gaps and overlaps of 1e-2, 1e-4 and 1e-6 of the size.
template <int Dim>
void expect_depths_of_all_features(const std::vector<Shape<Dim>>& shapes) {
  RandomStream random(51, 1);
  Counts counts;
  for (int trial = 0; trial < 500; ++trial) {
    const auto any = [&]() -> const Shape<Dim>& { return shapes[random.below(shapes.size())]; };
    const PlacedShape<Dim> first{&any(), 1.0, Vec<Dim>::Zero(), random_turn<Dim>(random)};
    PlacedShape<Dim> second{&any(), 1.3, Vec<Dim>::Zero(), random_turn<Dim>(random)};
    const double gap = (trial % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, -2.0 * (1 + trial / 2 % 3));
    const FeatureGap reached = set_gap<Dim>(first, second, random_direction<Dim>(random), gap);
    compare<Dim>(first, second, reached, counts);
    if (testing::Test::HasFatalFailure()) return;
  }
  // In the other pairs, the contact uses a face instead of an edge pair that is better by less than the margin.
  EXPECT_EQ(counts.compared, 500);
  EXPECT_GE(counts.exact, 490);
}

template <int Dim>
void expect_depths_of_all_generators(double rounding) {
  const bool is_plane = Dim == 2;
  expect_depths_of_all_features<Dim>(
      cut_shapes<Dim>({is_plane ? 5 : 10, is_plane ? 9 : 20, 0.3}, 30, rounding, 3));
  expect_depths_of_all_features<Dim>(
      hull_shapes<Dim>({is_plane ? 5 : 12, is_plane ? 9 : 24, 1.4}, 30, rounding, 3));
  expect_depths_of_all_features<Dim>(voronoi_shapes<Dim>({200, 2}, 30, rounding, 3));
}

TEST(ManifoldDepth, OfPolygonsIsThatOfAllVerticesAndSides) {
  expect_depths_of_all_generators<2>(0.0);
}
TEST(ManifoldDepth, OfPolyhedraIsThatOfAllFacesAndEdges) {
  expect_depths_of_all_generators<3>(0.0);
}
TEST(ManifoldDepth, OfRoundedPolygonsIsThatOfAllVerticesAndSides) {
  expect_depths_of_all_generators<2>(0.03);
}
TEST(ManifoldDepth, OfRoundedPolyhedraIsThatOfAllFacesAndEdges) {
  expect_depths_of_all_generators<3>(0.03);
}

}  // namespace
}  // namespace floc
