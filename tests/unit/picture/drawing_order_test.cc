#include "floc/picture/drawing_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "floc/packing/packing.h"
#include "floc/picture/hidden_spheres.h"
#include "floc/shape/generators.h"
#include "floc/shape/half_spaces.h"

namespace floc {
namespace {

View order_from_above() {
  View view;
  view.azimuth = -90.0;
  view.elevation = 90.0;
  return view;
}

/// Slightly shrunk Voronoi cells of random points in a box of side 4. They are convex bodies that nearly fill
/// space and do not overlap.
struct Cells {
  std::vector<Shape<3>> shapes;
  std::vector<PlacedShape<3>> placed;

  Cells() {
    constexpr int kCells = 60;
    constexpr double kSide = 4.0, kSize = 0.95;
    std::mt19937 engine(2);
    std::uniform_real_distribution<double> uniform(0.0, kSide);
    std::vector<Vec<3>> points;
    for (int i = 0; i < kCells; ++i) points.emplace_back(uniform(engine), uniform(engine), uniform(engine));
    for (int i = 0; i < kCells; ++i) {
      std::vector<HalfSpace<3>> half_spaces;
      for (int a = 0; a < 3; ++a) {
        half_spaces.push_back({Vec<3>::Unit(a), kSide - points[i][a]});
        half_spaces.push_back({-Vec<3>::Unit(a), points[i][a]});
      }
      for (int j = 0; j < kCells; ++j) {
        const Vec<3> apart = points[j] - points[i];
        if (j != i) half_spaces.push_back({apart, 0.5 * apart.squaredNorm()});
      }
      std::vector<Vec<3>> vertices = intersection_vertices<3>(half_spaces).value();
      for (Vec<3>& x : vertices) x += points[i];
      shapes.push_back(shape_of_points<3>(vertices, 0.0).shape);
    }
    for (const Shape<3>& shape : shapes) placed.push_back({&shape, kSize, shape.centre, shape.axes});
  }
};

/// Returns the depth at which a line of sight leaves a polyhedron on the side of the eye; absent if the line misses the
/// polyhedron.
std::optional<double> front_depth(const PlacedShape<3>& placed, const Vec<3>& eye, const Vec<3>& on_line) {
  const Vec<3> from = placed.rotation.transpose() * (on_line - placed.position) / placed.scale;
  const Vec<3> along = placed.rotation.transpose() * eye / placed.scale;
  double begin = -1e300, end = 1e300;
  for (int f = 0; f < placed.shape->n_faces(); ++f) {
    const double rise = placed.shape->normals[f].dot(along);
    const double at = (placed.shape->offsets[f] - placed.shape->normals[f].dot(from)) / rise;
    (rise > 0.0 ? end : begin) = rise > 0.0 ? std::min(end, at) : std::max(begin, at);
  }
  return begin < end ? std::optional(end) : std::nullopt;
}

TEST(DrawingOrder, TheBodyDrawnLastIsInFrontOnEveryLineOfSight) {
  const Cells cells;
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(0.0, 4.0);
  for (const auto& [azimuth, elevation] :
       {std::pair(-65.0, 20.0), std::pair(10.0, -35.0), std::pair(-90.0, 90.0)}) {
    View view;
    view.azimuth = azimuth;
    view.elevation = elevation;
    const Camera camera(view);
    const std::vector<int> order = drawing_order(cells.placed, camera);
    ASSERT_EQ(order.size(), cells.placed.size());
    const Vec<3> eye(camera.seen(Vec<3>::Unit(0))[2], camera.seen(Vec<3>::Unit(1))[2],
                     camera.seen(Vec<3>::Unit(2))[2]);
    int n_on_lines = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const Vec<3> on_line(uniform(engine), uniform(engine), uniform(engine));
      double last = -1e300;
      for (const int i : order)
        if (const auto depth = front_depth(cells.placed[i], eye, on_line)) {
          EXPECT_GT(*depth, last);
          last = *depth;
          ++n_on_lines;
        }
    }
    EXPECT_GT(n_on_lines, 600);
  }
}

TEST(DrawingOrder, APlankOverASphereIsDrawnLaterThoughItsCentreIsFarther) {
  const Shape<3> plank = box<3>({6.0, 1.0, 0.4}, 0.0), ball = round_shape<3>(0.3), rod = capsule<3>(10.0);
  const double slope = std::atan(2.0 / 3.0);
  const auto tilted = [&](const Shape<3>& shape) {
    // The first axis of a shape is its longest axis.
    return PlacedShape<3>{&shape, 6.0, Vec<3>::Zero(),
                          rotation_matrix(Eigen::Quaterniond(Eigen::AngleAxisd(-slope, Vec<3>::UnitY())))};
  };
  const auto at = [&](const Vec<3>& x) { return PlacedShape<3>{&ball, 1.0, x, Mat<3>::Identity()}; };
  for (const Shape<3>& long_one : {plank, rod}) {
    // At x = 2, where the sphere is, the long body is at height 1.33, although its centre is at height 0.
    EXPECT_EQ(drawing_order({tilted(long_one), at({2.0, 0.0, 0.4})}, Camera(order_from_above())),
              (std::vector<int>{1, 0}));
    EXPECT_EQ(drawing_order({at({-2.0, 0.0, -0.4}), tilted(long_one)}, Camera(order_from_above())),
              (std::vector<int>{1, 0}));
  }
}

TEST(DrawingOrder, HoldsEachBodyOfACycleOnce) {
  // Three sticks along the sides of a triangle. Each stick lies above the next stick, so no order of drawing is right.
  const Shape<3> stick = box<3>({10.0, 1.0, 1.0}, 0.0);
  std::vector<PlacedShape<3>> sticks;
  for (int k = 0; k < 3; ++k) {
    const double angle = 2.0 / 3.0 * std::numbers::pi * k;
    const Eigen::Quaterniond turn =
        Eigen::AngleAxisd(angle, Vec<3>::UnitZ()) * Eigen::AngleAxisd(0.3, Vec<3>::UnitY());
    sticks.push_back({&stick, 4.0, {std::sin(angle), -std::cos(angle), 0.0}, rotation_matrix(turn)});
  }
  std::vector<int> order = drawing_order(sticks, Camera(order_from_above()));
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2}));
}

TEST(HiddenBodies, AreBehindASphereInsideAnother) {
  // A wall of bodies whose inscribed spheres hide the space behind them, and three more bodies: one behind the wall,
  // one farther back beside the wall, and one within the wall. The last one may stick out in front, so it is not
  // hidden.
  std::vector<BodyExtent> bodies;
  for (int x = -6; x <= 6; ++x)
    for (int y = -6; y <= 6; ++y) bodies.push_back({{0.5 * x, 0.5 * y, 1.0}, 0.5, 0.8});
  bodies.push_back({{0.2, 0.3, -0.1}, 0.5, 0.8});
  bodies.push_back({{3.2, 0.3, -0.1}, 0.5, 0.8});
  bodies.push_back({{0.2, 0.3, 0.3}, 0.5, 0.8});
  const std::vector<bool> hidden = hidden_bodies(bodies);
  const std::size_t n_wall = 13 * 13;
  EXPECT_EQ(std::count(hidden.begin(), hidden.end(), true), 1);
  EXPECT_TRUE(hidden[n_wall]);
}

}  // namespace
}  // namespace floc
