#include "floc/shape/shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/message_of.h"
#include "unit/shape/solids.h"

namespace floc {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

Vec<3> sorted(Vec<3> v) {
  std::sort(v.data(), v.data() + 3);
  return v;
}

/// Returns the distance from a core to a point outside of it, computed by alternating projections on the half-spaces of
/// the core (Dykstra 1983).
template <int Dim>
double distance_to_core(const Shape<Dim>& shape, const Vec<Dim>& point) {
  std::vector<Vec<Dim>> correction(shape.n_faces(), Vec<Dim>::Zero());
  Vec<Dim> x = point;
  for (int sweep = 0; sweep < 60; ++sweep)
    for (int f = 0; f < shape.n_faces(); ++f) {
      const Vec<Dim> y = x + correction[f];
      x = y - std::max(0.0, shape.normals[f].dot(y) - shape.offsets[f]) * shape.normals[f];
      correction[f] = y - x;
    }
  return (point - x).norm();
}

// Volumes and moments with a closed form are compared up to rounding. Values that were given as decimals are compared
// up to their last digit.
TEST(MassProperties, BoxAndRegularSolidsHaveTheirClosedForms) {
  const Shape<3> box = shape_of<3>(box_points(1, 2, 3));
  EXPECT_NEAR(box.volume, 6.0, 1e-14);
  EXPECT_NEAR((sorted(box.inertia / box.volume * 6.0) - Vec<3>(2.5, 5.0, 6.5)).norm(), 0.0, 1e-13);
  EXPECT_NEAR(box.outer_radius, std::sqrt(3.5), 1e-15);
  EXPECT_NEAR(box.inner_radius, 0.5, 1e-15);
  EXPECT_EQ(box.n_faces(), 6);
  EXPECT_EQ(box.n_edges(), 12);
  const double a = std::sqrt(8.0);
  const Shape<3> tetrahedron = shape_of<3>(tetrahedron_points());
  EXPECT_NEAR(tetrahedron.volume, a * a * a / (6.0 * std::numbers::sqrt2), 1e-14);
  EXPECT_NEAR((tetrahedron.inertia / (tetrahedron.volume * a * a) - Vec<3>::Constant(1.0 / 20.0)).norm(), 0.0,
              1e-15);
  const Shape<3> octahedron = shape_of<3>(octahedron_points());
  EXPECT_NEAR(octahedron.volume, 4.0 / 3.0, 1e-15);
  EXPECT_NEAR((octahedron.inertia / octahedron.volume - Vec<3>::Constant(0.2)).norm(), 0.0, 1e-15);
  const Shape<3> icosahedron = shape_of<3>(icosahedron_points());
  EXPECT_EQ(icosahedron.n_faces(), 20);
  EXPECT_EQ(icosahedron.n_edges(), 30);
  EXPECT_NEAR(icosahedron.volume, 17.453559924999, 5e-13);
  EXPECT_NEAR((icosahedron.inertia / (4.0 * icosahedron.volume) - Vec<3>::Constant(0.261803398875)).norm(), 0.0,
              1e-12);
}

TEST(MassProperties, PolygonsHaveTheirClosedForms) {
  const Shape<2> pentagon = shape_of<2>(polygon_points(5));
  EXPECT_NEAR(pentagon.volume, 2.377641290737884, 1e-15);
  EXPECT_NEAR(pentagon.inertia[0] / pentagon.volume, 0.384836165729158, 1e-15);
  EXPECT_NEAR(pentagon.inner_radius, std::cos(kPi / 5.0), 1e-15);
  const Shape<2> triangle = shape_of<2>({{7, 0}, {10, 0}, {7, 4}});
  EXPECT_NEAR(triangle.volume, 6.0, 1e-14);
  EXPECT_NEAR(triangle.inertia[0] / triangle.volume, 1.388888888888889, 1e-14);
  EXPECT_NEAR((triangle.centre - Vec<2>(8, 4.0 / 3.0)).norm(), 0.0, 1e-14);
}

TEST(MassProperties, RoundOnesAndCapsulesHaveTheirClosedForms) {
  const Shape<3> sphere = round_shape<3>(2.0);
  EXPECT_NEAR(sphere.volume, 32.0 / 3.0 * kPi, 1e-13);
  EXPECT_NEAR(sphere.inertia[1], 0.4 * sphere.volume * 4.0, 1e-12);
  EXPECT_NEAR(round_shape<2>(2.0).inertia[0], 8.0 * kPi, 1e-13);
  // A capsule in 2D consists of a rectangle and two half disks. The centre of mass of a half disk is 4 rho/(3 pi)
  // beyond the end of the core.
  const double length = 1.3, rho = 0.4;
  const Shape<2> flat = capsule_shape<2>(length, rho);
  EXPECT_NEAR(flat.volume, 2.0 * rho * length + kPi * rho * rho, 1e-15);
  EXPECT_NEAR(
      flat.inertia[0],
      2.0 * rho * length * (length * length + 4.0 * rho * rho) / 12.0 +
          kPi * rho * rho * (0.25 * length * length + 4.0 * rho * length / (3.0 * kPi) + 0.5 * rho * rho),
      1e-15);
  EXPECT_NEAR(flat.diameter(), length + 2.0 * rho, 1e-15);
  // A capsule in 3D is the limit of a thin rounded box.
  const Shape<3> capsule = capsule_shape<3>(length, rho);
  const double thin = length / 19.9;
  const Shape<3> box = shape_of<3>(box_points(length, thin, thin), rho);
  EXPECT_NEAR(capsule.volume, kPi * rho * rho * length + 4.0 / 3.0 * kPi * rho * rho * rho, 1e-15);
  EXPECT_NEAR(box.volume,
              capsule.volume + 2.0 * rho * thin * (2.0 * length + thin) + kPi * rho * rho * 2.0 * thin +
                  length * thin * thin,
              1e-13);
}

TEST(MassProperties, RoundedBoxHasItsClosedForm) {
  // The rounded box consists of a box a x b x c, slabs on its faces, quarter cylinders at its edges and eighths of a
  // ball at its corners.
  const double a = 1.0, b = 0.7, c = 0.4, r = 0.3;
  const Shape<3> box = shape_of<3>(box_points(a, b, c), r);
  const double volume =
      a * b * c + 2.0 * r * (a * b + b * c + c * a) + kPi * r * r * (a + b + c) + 4.0 / 3.0 * kPi * r * r * r;
  EXPECT_NEAR(box.volume, volume, 1e-14);
  // The moment of x^2 is an integral over slices at constant x. For |x| < a/2, a slice is the rectangle b x c rounded
  // by r. At a distance s beyond the end of the core, the slice is this rectangle rounded by sqrt(r^2 - s^2).
  const auto area = [&](double rho) { return b * c + 2.0 * (b + c) * rho + kPi * rho * rho; };
  double xx = a * a * a / 12.0 * area(r);
  constexpr int kSlices = 2000;
  for (int k = 0; k < kSlices; ++k) {
    const double angle = 0.5 * kPi * (k + 0.5) / kSlices, s = r * std::sin(angle), x = 0.5 * a + s;
    xx += 2.0 * x * x * area(r * std::cos(angle)) * r * std::cos(angle) * 0.5 * kPi / kSlices;
  }
  const double trace = 0.5 * box.inertia.sum();
  EXPECT_NEAR(trace - box.inertia[0], xx, 1e-7);  // the quadrature is of second order
}

template <int Dim>
class MassPropertiesIn : public testing::Test {};

template <int Dim>
void expect_random_points_agree(double rounding) {
  RandomStream random(5, 1);
  const Shape<Dim> shape = shape_of<Dim>(random_points<Dim>(random, 9), rounding);
  const double side = 2.0 * shape.outer_radius;
  Vec<Dim> first = Vec<Dim>::Zero();
  Mat<Dim> second = Mat<Dim>::Zero();
  constexpr int kTrials = 40000;
  int inside = 0;
  for (int k = 0; k < kTrials; ++k) {
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = (random.uniform() - 0.5) * side;
    if (distance_to_core(shape, x) > rounding + 1e-9) continue;
    ++inside;
    first += x;
    second += x * x.transpose();
  }
  // The tolerance is five standard deviations of 40 000 trials.
  const double box = std::pow(side, Dim), each = box / kTrials, tolerance = 5.0 / std::sqrt(kTrials);
  EXPECT_NEAR(inside * each, shape.volume, 0.5 * tolerance * box);
  EXPECT_LT((first * each).norm(), tolerance * box * 0.3);
  for (int a = 0; a < kRotations<Dim>; ++a) {
    const double moment = Dim == 2 ? second.trace() : second.trace() - second(a, a);
    EXPECT_NEAR(moment * each, shape.inertia[a], tolerance * box * 0.3);
  }
}

TEST(MassProperties, AgreeWithRandomPointsSharpAndRounded) {
  for (const double rounding : {0.0, 0.3}) {
    expect_random_points_agree<2>(rounding);
    expect_random_points_agree<3>(rounding);
  }
}

/// The convex hull of points on the rounded corners approaches the rounded shape if the number of points increases.
TEST(MassProperties, RoundedOnesAreTheLimitOfFineHulls) {
  const std::vector<Vec<2>> core = {{0, 0}, {1, 0.1}, {0.3, 0.8}};
  const double rho = 0.2;
  std::vector<Vec<2>> fine;
  for (const Vec<2>& v : core)
    for (int k = 0; k < 60; ++k) {
      const double angle = 2.0 * kPi * (k + 0.123) / 60;
      fine.push_back(v + rho * Vec<2>(std::cos(angle), std::sin(angle)));
    }
  const Shape<2> rounded = shape_of<2>(core, rho), limit = shape_of<2>(fine);
  // The sides of a polygon with 60 corners lie up to 3e-4 inside its circle, along a perimeter of 4.
  EXPECT_NEAR(limit.volume, rounded.volume, 1e-3);
  EXPECT_NEAR(limit.inertia[0], rounded.inertia[0], 3e-4 * rounded.inertia[0] * 10.0);
  EXPECT_NEAR((limit.centre - rounded.centre).norm(), 0.0, 1e-4);
}

template <int Dim>
void expect_invariance_under_rotation() {
  RandomStream random(11, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<Vec<Dim>> points = random_points<Dim>(random, 6 + trial % 20);
    std::vector<Vec<Dim>> moved = points;
    const Mat<Dim> turn = random_turn<Dim>(random);
    const Vec<Dim> shift = 5.0 * random_direction<Dim>(random);
    for (Vec<Dim>& p : moved) p = (turn * p + shift).eval();
    const double rounding = trial % 2 ? 0.1 : 0.0;
    const Shape<Dim> one = shape_of<Dim>(points, rounding), other = shape_of<Dim>(moved, rounding);
    EXPECT_NEAR(one.volume, other.volume, 1e-13);
    RotationVector<Dim> a = one.inertia, b = other.inertia;
    std::sort(a.data(), a.data() + a.size());
    std::sort(b.data(), b.data() + b.size());
    EXPECT_NEAR((a - b).norm(), 0.0, 1e-13);
    EXPECT_NEAR((turn * one.centre + shift - other.centre).norm(), 0.0, 1e-13);
    EXPECT_NEAR(other.axes.determinant(), 1.0, 1e-13);
    // The original points must be obtained again from the vertices in the coordinates of the shape and from its centre
    // and axes.
    for (int v = 0; v < other.n_vertices(); ++v) {
      const Vec<Dim> given = other.centre + other.axes * other.vertices[v];
      double nearest = 1.0;
      for (const Vec<Dim>& p : moved) nearest = std::min(nearest, (p - given).norm());
      EXPECT_LT(nearest, 1e-13);
    }
  }
}

TEST(MassProperties, DoNotDependOnPlaceAndRotation) {
  expect_invariance_under_rotation<2>();
  expect_invariance_under_rotation<3>();
}

TEST(Shape, HasClosedConvexFacesAndEdgesWithTwoOfThem) {
  RandomStream random(3, 1);
  for (int trial = 0; trial < 100; ++trial) {
    const Shape<3> shape = shape_of<3>(random_points<3>(random, 4 + 2 * trial));
    EXPECT_EQ(shape.n_vertices() - shape.n_edges() + shape.n_faces(), 2);  // Euler
    for (int f = 0; f < shape.n_faces(); ++f)
      for (const Vec<3>& v : shape.vertices) EXPECT_LT(shape.normals[f].dot(v) - shape.offsets[f], 1e-10);
    for (const ShapeEdge& e : shape.edges) {
      const Vec<3> along = shape.vertices[e.to] - shape.vertices[e.from];
      EXPECT_GT(shape.normals[e.left].cross(shape.normals[e.right]).dot(along), 0.0);
    }
    for (int v = 0; v < shape.n_vertices(); ++v)
      for (const int f : shape.faces_at(v)) EXPECT_THAT(shape.loop(f), testing::Contains(v));
  }
}

TEST(Shape, ScaledOnesScaleByTheirDimension) {
  const Shape<3> one = shape_of<3>(box_points(1, 2, 3), 0.1), other = scaled(one, 2.0);
  EXPECT_NEAR(other.volume, 8.0 * one.volume, 1e-12);
  EXPECT_NEAR((other.inertia - 32.0 * one.inertia).norm(), 0.0, 1e-11);
  EXPECT_NEAR(other.diameter(), 2.0 * one.diameter(), 1e-14);
  EXPECT_NEAR(round_shape<3>(0.5).equal_volume_diameter(), 1.0, 1e-15);
  EXPECT_NEAR(round_shape<2>(0.5).equal_volume_diameter(), 1.0, 1e-15);
}

TEST(Shape, OfUnitDiameterHasTheRoundingAskedFor) {
  for (const double share : {0.0, 0.05, 0.45}) {
    const Polytope<2> core = convex_hull<2>({{0, 0}, {3, 0}, {0, 1}}).polytope;
    const Shape<2> shape = with_unit_diameter<2>(core, share);
    EXPECT_NEAR(shape.diameter(), 1.0, 1e-14);
    EXPECT_NEAR(shape.rounding, share, 1e-14);
  }
  const Polytope<2> core = convex_hull<2>(polygon_points(5)).polytope;
  EXPECT_THAT(test::message_of([&] { with_unit_diameter<2>(core, 0.5); }), HasSubstr("from 0 to 0.45"));
}

TEST(Hull, MergesCoplanarTrianglesAndLeavesOutPointsOnThem) {
  // Of the lattice of 5 x 5 x 5 points, 98 lie on the surface, eight of them at vertices.
  std::vector<Vec<3>> points;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z) points.emplace_back(x, y, z);
  RandomStream random(2, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const Mat<3> turn = trial == 0 ? Mat<3>(Mat<3>::Identity()) : random_turn<3>(random);
    for (Vec<3>& p : points) p = (turn * p).eval();
    const ConvexHull<3> hull = convex_hull<3>(points);
    EXPECT_EQ(hull.points.size(), 8u);
    EXPECT_EQ(hull.polytope.faces.size(), 6u);
    for (const std::vector<int>& loop : hull.polytope.faces) EXPECT_EQ(loop.size(), 4u);
    EXPECT_NEAR(polytope_shape<3>(hull.polytope, 0.0).volume, 64.0, 1e-11);
  }
  EXPECT_EQ(convex_hull<2>({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}}).points,
            (std::vector<int>{0, 2, 3, 5}));
  const auto made = shape_of_points<2>({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}, 0.0);
  ASSERT_EQ(made.remarks.size(), 1u);
  EXPECT_EQ(made.remarks[0], "1 of 5 points are not vertices of the convex hull, which is used as the shape");
}

TEST(Hull, OfPointsOnASphereHasThemAll) {
  RandomStream random(4, 1);
  std::vector<Vec<3>> points;
  for (int k = 0; k < 3000; ++k) points.push_back(random_direction<3>(random));
  const ConvexHull<3> hull = convex_hull<3>(points);
  EXPECT_EQ(hull.points.size(), points.size());
  EXPECT_EQ(hull.polytope.faces.size(), 2 * points.size() - 4);
  EXPECT_THAT(test::message_of([&] { polytope_shape<3>(hull.polytope, 0.0, "x.stl"); }),
              HasSubstr("x.stl: the convex hull has 3000 vertices: expected at most 200"));
}

TEST(Shape, RefusesBadPointsInWords) {
  const auto message = [](const std::vector<Vec<3>>& points) {
    return test::message_of([&] { shape_of_points<3>(points, 0.0, "p.csv"); });
  };
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
              HasSubstr("p.csv: found 3 points, expected at least 4"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), HasSubstr("in one plane"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), HasSubstr("in one plane"));
  EXPECT_THAT(message({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), HasSubstr("in one plane"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e-5}}), HasSubstr("as long as it is thick"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1 + 5e-10}, {1, 1, 1}}),
              HasSubstr("points 4 and 5 are equal"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e-7}}), HasSubstr("nearly in one plane"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 1, 0}, {1, 1, 1e-5}, {1.000003, 1, 0}}), HasSubstr("flat"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}}),
              HasSubstr("points 2 and 5 are equal"));
  EXPECT_THAT(message({{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}, {0, 0, 1}}),
              HasSubstr("point 3: expected coordinates"));
  EXPECT_THAT(message({{0, 0, 4}, {2e8, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0.5, 0.4, 1}}),
              HasSubstr("nearly on one line or in one plane"));
  EXPECT_THAT(message(box_points(1, 1, 21)), HasSubstr("21 times as long as it is thick: expected at most 20"));
  EXPECT_THAT(test::message_of([] {
                shape_of_points<2>({{0, 0}, {1, 1}, {2, 2}, {3, 3}}, 0.0);
              }),
              HasSubstr("on one line"));
  EXPECT_THAT(test::message_of([] {
                shape_of_points<2>({{0, 0}, {2e8, 0}, {1, 1}, {0, 1}}, 0.0);
              }),
              HasSubstr("2e+08 times as long as it is thick"));
}

}  // namespace
}  // namespace floc
