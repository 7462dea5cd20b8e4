#include "floc/picture/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/packing/packing.h"
#include "floc/shape/generators.h"
#include "support/outline_area.h"

namespace floc {
namespace {

using test::area_of;

Vec<2> on_circle(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

std::vector<Shape<2>> some_shapes() {
  std::vector<Shape<2>> shapes = {regular_polygon(5, 0.0), regular_polygon(3, 0.1), box<2>({3.0, 1.0}, 0.0),
                                  box<2>({3.0, 1.0}, 0.2), capsule<2>(2.5)};
  for (const Shape<2>& shape : hull_shapes<2>({}, 5, 0.07, 1)) shapes.push_back(shape);
  return shapes;
}

TEST(Outline, EnclosesTheAreaOfTheShape) {
  for (const Shape<2>& shape : some_shapes())
    for (const double angle : {0.0, 0.7, 3.1, -2.0}) {
      const PlacedShape<2> placed{&shape, 1.7, {3.0, -2.0}, rotation_matrix(angle)};
      EXPECT_NEAR(area_of(outline_of(placed)), 1.7 * 1.7 * shape.volume, 1e-12);
    }
}

TEST(Outline, ArcsMeetTheSidesAndTurnOnceInAll) {
  for (const Shape<2>& shape : some_shapes()) {
    const Outline outline = outline_of({&shape, 2.0, {1.0, 1.0}, rotation_matrix(0.4)});
    EXPECT_EQ(outline.radius, 2.0 * shape.rounding);
    double turned = 0.0;
    for (std::size_t k = 0; k < outline.corners.size(); ++k) {
      const OutlineCorner& corner = outline.corners[k];
      const OutlineCorner& next = outline.corners[(k + 1) % outline.corners.size()];
      turned += corner.end - corner.begin;
      // The straight side is perpendicular to the radius at both of its ends.
      const Vec<2> side = next.centre - corner.centre;
      EXPECT_NEAR(side.dot(on_circle(corner.end)), 0.0, 1e-14);
      EXPECT_NEAR(side.dot(on_circle(next.begin)), 0.0, 1e-14);
    }
    EXPECT_NEAR(turned, 2.0 * std::numbers::pi, 1e-12);
  }
}

}  // namespace
}  // namespace floc
