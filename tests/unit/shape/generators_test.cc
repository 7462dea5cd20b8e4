#include "floc/shape/generators.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/shape/voronoi_cells.h"
#include "support/message_of.h"
#include "unit/shape/solids.h"

namespace floc {
namespace {

using testing::HasSubstr;

template <int Dim>
void expect_bodies_of_unit_diameter(const std::vector<Shape<Dim>>& shapes, std::size_t count, double rounding) {
  ASSERT_EQ(shapes.size(), count);
  for (const Shape<Dim>& shape : shapes) {
    EXPECT_NEAR(shape.diameter(), 1.0, 1e-14);
    EXPECT_NEAR(shape.rounding, rounding, 1e-14);
    EXPECT_GT(shape.volume, 0.05);
    EXPECT_GT(shape.inertia.minCoeff(), 0.0);
    EXPECT_GT(shape.inner_radius, 0.05);
  }
}

template <int Dim>
bool equal(const std::vector<Shape<Dim>>& a, const std::vector<Shape<Dim>>& b) {
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    if (a[k].vertices != b[k].vertices || a[k].corners != b[k].corners) return false;
  return true;
}

template <int Dim>
void expect_that_seeds_decide(auto generate) {
  EXPECT_TRUE(equal<Dim>(generate(10, 1), generate(10, 1)));
  EXPECT_TRUE(equal<Dim>(generate(10, 1), generate(20, 1)));
  EXPECT_FALSE(equal<Dim>(generate(10, 1), generate(10, 2)));
  expect_bodies_of_unit_diameter<Dim>(generate(20, 3), 20, 0.03);
}

TEST(Generators, MakeOneSetOfShapesOfOneSeed) {
  expect_that_seeds_decide<2>([](int n, int seed) { return hull_shapes<2>({6, 9, 1.4}, n, 0.03, seed); });
  expect_that_seeds_decide<3>([](int n, int seed) { return hull_shapes<3>({}, n, 0.03, seed); });
  expect_that_seeds_decide<2>([](int n, int seed) { return cut_shapes<2>({5, 8, 0.3}, n, 0.03, seed); });
  expect_that_seeds_decide<3>([](int n, int seed) { return cut_shapes<3>({}, n, 0.03, seed); });
  expect_that_seeds_decide<2>([](int n, int seed) { return voronoi_shapes<2>({50, 1}, n, 0.03, seed); });
  expect_that_seeds_decide<3>([](int n, int seed) { return voronoi_shapes<3>({50, 1}, n, 0.03, seed); });
}

TEST(Generators, PolygonsBoxesAndCapsulesHaveTheirClosedForms) {
  EXPECT_NEAR(regular_polygon(6, 0.0).volume, 0.25 * 1.5 * std::sqrt(3.0), 1e-15);
  const Shape<3> cube = box<3>({2, 2, 2}, 0.0);
  EXPECT_NEAR(cube.volume, std::pow(3.0, -1.5), 1e-15);
  EXPECT_NEAR(box<2>({3, 4}, 0.0).volume, 0.48, 1e-15);
  EXPECT_NEAR(capsule<3>(2.0).volume, std::numbers::pi * (0.25 * 0.25 * 0.5 + 4.0 / 3.0 / 64.0), 1e-15);
  EXPECT_TRUE(capsule<2>(1.0).is_round());
  EXPECT_NEAR(capsule<2>(3.0).diameter(), 1.0, 1e-15);
}

// The expected counts were measured on other samples of these generators. The mean number of faces has a standard error
// of 0.2 for 300 shapes.
TEST(Generators, HullsAndCutsHaveTheFacesOfTheDesign) {
  double faces = 0.0, vertices = 0.0;
  const auto hulls = hull_shapes<3>({}, 300, 0.0, 1);
  for (const Shape<3>& shape : hulls) {
    EXPECT_GE(shape.n_faces(), 20);
    EXPECT_LE(shape.n_faces(), 44);
    faces += shape.n_faces() / 300.0;
  }
  EXPECT_NEAR(faces, 31.5, 1.5);
  faces = 0.0;
  for (const Shape<3>& shape : cut_shapes<3>({}, 300, 0.0, 1))
    faces += shape.n_faces() / 300.0, vertices += shape.n_vertices() / 300.0;
  EXPECT_NEAR(faces, 14.8, 0.7);
  EXPECT_NEAR(vertices, 25.6, 1.4);
}

TEST(Generators, AspectStretchesHulls) {
  double ratio = 0.0;
  for (const Shape<3>& shape : hull_shapes<3>({20, 24, 3.0}, 50, 0.0, 1))
    ratio += std::sqrt(shape.inertia.maxCoeff() / shape.inertia.minCoeff()) / 50.0;
  EXPECT_NEAR(ratio, std::sqrt((9.0 + 1.0) / 2.0), 0.2);  // aspect ratio of the ellipsoid
}

TEST(Voronoi, CellsFillTheBox) {
  for (const int n : {8, 60, 300}) {
    double area = 0.0, volume = 0.0;
    for (const auto& cell : voronoi_cells<2>(n, 1, 7)) area += test::shape_of<2>(cell).volume;
    for (const auto& cell : voronoi_cells<3>(n, 1, 7)) volume += test::shape_of<3>(cell).volume;
    EXPECT_NEAR(area, 1.0, 1e-9) << n;
    EXPECT_NEAR(volume, 1.0, 1e-9) << n;
  }
}

TEST(Voronoi, RelaxedCellsAreRounder) {
  const auto filling = [](int relaxed) {
    double sum = 0.0;
    for (const Shape<3>& shape : voronoi_shapes<3>({200, relaxed}, 100, 0.0, 1)) sum += shape.volume;
    return sum;
  };
  EXPECT_GT(filling(5), 1.2 * filling(0));
}

TEST(Generators, RefuseWhatIsOutOfRangeInWords) {
  EXPECT_THAT(test::message_of([] { regular_polygon(2, 0.0); }),
              HasSubstr("sides = 2: expected a whole number from 3 to 200"));
  EXPECT_THAT(test::message_of([] { regular_polygon(5, 0.6); }), HasSubstr("rounding = 0.6"));
  EXPECT_THAT(test::message_of([] { box<3>({1, -1, 1}, 0.0); }), HasSubstr("sides[1] = -1"));
  EXPECT_THAT(test::message_of([] { box<3>({1, 30, 1}, 0.0); }), HasSubstr("as long as it is thick"));
  EXPECT_THAT(test::message_of([] { capsule<2>(0.5); }), HasSubstr("aspect = 0.5"));
  EXPECT_THAT(test::message_of([] { hull_shapes<3>({3, 10, 1.0}, 1, 0.0, 1); }), HasSubstr("vertices[0] = 3"));
  EXPECT_THAT(test::message_of([] {
                hull_shapes<3>({10, 5, 1.0}, 1, 0.0, 1);
              }),
              HasSubstr("the smaller number first"));
  EXPECT_THAT(test::message_of([] { cut_shapes<3>({10, 500, 0.3}, 1, 0.0, 1); }), HasSubstr("faces[1] = 500"));
  EXPECT_THAT(test::message_of([] {
                voronoi_shapes<3>({10, 0}, 11, 0.0, 1);
              }),
              HasSubstr("count = 11: expected at most 10"));
  EXPECT_THAT(test::message_of([] { hull_shapes<2>({}, 0, 0.0, 1); }), HasSubstr("count = 0"));
}

}  // namespace
}  // namespace floc
