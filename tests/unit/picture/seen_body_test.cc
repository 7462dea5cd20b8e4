#include "floc/picture/seen_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/shape/generators.h"

namespace floc {
namespace {

constexpr double kBodyRounding = 1e-12;

/// Returns the volume inside the facets, as the sum of pyramids from the origin to each facet.
double volume_of(const Facets& facets) {
  double volume = 0.0;
  for (const Facets::Facet& facet : facets.facets)
    for (std::size_t k = 1; k + 1 < facet.corners.size(); ++k) {
      const auto& x = facets.points;
      volume += x[facet.corners[0]].dot(x[facet.corners[k]].cross(x[facet.corners[k + 1]])) / 6.0;
    }
  return volume;
}

SeenBody seen_from_above(const PlacedShape<3>& placed) {
  View view;
  view.azimuth = -90.0;
  view.elevation = 90.0;
  return seen_body(placed, placed.shape->n_faces() > 0 ? facets_of(*placed.shape) : Facets(), Camera(view), 0);
}

TEST(Facets, AreTheFacesOfASharpPolyhedron) {
  for (const Shape<3>& shape : cut_shapes<3>({}, 5, 0.0, 1)) {
    const Facets facets = facets_of(shape);
    EXPECT_EQ(static_cast<int>(facets.facets.size()), shape.n_faces());
    EXPECT_NEAR(volume_of(facets), shape.volume, kBodyRounding);
  }
}

TEST(Facets, OfARoundedBoxHaveABevelForEachEdgeAndCorner) {
  const Shape<3> shape = box<3>({1.0, 1.0, 1.0}, 0.1);
  const Facets facets = facets_of(shape);
  EXPECT_EQ(facets.facets.size(), 6u + 12u + 8u);
  // The body consists of a core, six slabs on its faces, twelve prisms along its edges and eight pyramids at
  // its corners.
  const double side = 2.0 * std::abs(shape.vertices[0][0]), r = shape.rounding;
  EXPECT_NEAR(volume_of(facets),
              std::pow(side, 3) + 6.0 * side * side * r + 12.0 * side * r * r / 2.0 + 8.0 * r * r * r / 6.0,
              kBodyRounding);
}

TEST(Facets, OfRoundedPolyhedraTurnOutwardsAndStayWithinThem) {
  for (const Shape<3>& shape : cut_shapes<3>({}, 5, 0.08, 1)) {
    const Facets facets = facets_of(shape);
    EXPECT_EQ(static_cast<int>(facets.facets.size()), shape.n_faces() + shape.n_edges() + shape.n_vertices());
    EXPECT_LT(volume_of(facets), shape.volume);
    EXPECT_GT(volume_of(facets), 0.9 * shape.volume);
    for (const Facets::Facet& facet : facets.facets) {
      const auto x = [&](std::size_t k) { return facets.points[facet.corners[k]]; };
      for (std::size_t k = 1; k + 1 < facet.corners.size(); ++k)
        EXPECT_GT((x(k) - x(0)).cross(x(k + 1) - x(0)).dot(facet.normal), 0.0);
    }
  }
}

/// Returns shapes of several kinds with random orientations.
std::vector<PlacedShape<3>> placed_shapes(const std::vector<Shape<3>>& shapes) {
  std::vector<PlacedShape<3>> placed;
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  for (const Shape<3>& shape : shapes) {
    const Eigen::Quaterniond turn(normal(engine), normal(engine), normal(engine), normal(engine));
    placed.push_back({&shape, 1.5, {0.2, -0.1, 0.3}, rotation_matrix(turn.normalized())});
  }
  return placed;
}

/// Returns the distance (length) of a point from the core of a shape. For a polyhedron, the function returns
/// the largest height above a face, which is negative inside the polyhedron.
double height_above(const PlacedShape<3>& placed, const Vec<3>& point) {
  const Vec<3> x = placed.rotation.transpose() * (point - placed.position) / placed.scale;
  const Shape<3>& shape = *placed.shape;
  double height = -1e300;
  if (shape.n_faces() > 0) {
    for (int f = 0; f < shape.n_faces(); ++f)
      height = std::max(height, shape.normals[f].dot(x) - shape.offsets[f]);
  } else {
    const double half = shape.vertices[1].norm();
    const double along = std::clamp(x.dot(shape.vertices[1]) / half, -half, half);
    height = (x - along * shape.vertices[1] / half).norm();
  }
  return placed.scale * (height - shape.rounding);
}

TEST(DistanceToSurface, EndsOnTheSurface) {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  const std::vector<Shape<3>> shapes = {box<3>({1.0, 2.0, 3.0}, 0.0), cut_shapes<3>({}, 1, 0.0, 4)[0],
                                        capsule<3>(1.2), capsule<3>(6.0)};
  for (const PlacedShape<3>& placed : placed_shapes(shapes))
    for (int trial = 0; trial < 50; ++trial) {
      const Vec<3> direction = Vec<3>(normal(engine), normal(engine), normal(engine)).normalized();
      const double distance = distance_to_surface(placed, direction);
      EXPECT_NEAR(height_above(placed, placed.position + distance * direction), 0.0, kBodyRounding);
    }
}

TEST(HiddenParts, OfBodiesAgreeWithRays) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  const std::vector<Shape<3>> shapes = {box<3>({1.0, 2.0, 3.0}, 0.0), cut_shapes<3>({}, 1, 0.0, 4)[0],
                                        capsule<3>(3.0)};
  for (const PlacedShape<3>& placed : placed_shapes(shapes)) {
    const SeenBody body = seen_from_above(placed);
    int n_hidden = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const Vec<3> from(uniform(engine), uniform(engine), uniform(engine));
      const Vec<3> to(uniform(engine), uniform(engine), uniform(engine));
      std::vector<std::pair<double, double>> parts;
      add_hidden_parts(from, to, body, parts);
      for (const double t : {0.03, 0.21, 0.48, 0.74, 0.96}) {
        // The smallest height above the surface on the ray from the point towards the eye, sampled in steps of 0.003.
        double least = 1e300;
        for (int k = 0; k < 1000; ++k)
          least = std::min(least, height_above(placed, from + t * (to - from) + Vec<3>(0.0, 0.0, 0.003 * k)));
        if (std::abs(least) < 0.01) continue;
        bool hidden = false;
        for (const auto& [begin, end] : parts) hidden = hidden || (t > begin && t < end);
        EXPECT_EQ(hidden, least < 0.0);
        n_hidden += hidden;
      }
    }
    EXPECT_GT(n_hidden, 30);
  }
}

}  // namespace
}  // namespace floc
