#include <gtest/gtest.h>

#include "floc/shape/manifold.h"
#include "unit/shape/feature_distance.h"

namespace floc {
namespace {

using namespace test;

/// Returns needles and plates of aspect ratio 20, and intermediate shapes.
template <int Dim>
std::vector<Shape<Dim>> extreme_shapes(double rounding);
template <>
std::vector<Shape<2>> extreme_shapes(double rounding) {
  return {box<2>({20, 1}, rounding),      box<2>({1, 1}, rounding),
          regular_polygon(3, rounding),   regular_polygon(5, rounding),
          regular_polygon(200, rounding), hull_shapes<2>({6, 9, 10.0}, 1, rounding, 3)[0]};
}
template <>
std::vector<Shape<3>> extreme_shapes(double rounding) {
  return {box<3>({20, 1, 1}, rounding),
          box<3>({20, 20, 1}, rounding),
          box<3>({1, 1, 1}, rounding),
          with_unit_diameter<3>(convex_hull<3>(tetrahedron_points()).polytope, rounding),
          cut_shapes<3>({}, 1, rounding, 3)[0],
          hull_shapes<3>({}, 1, rounding, 3)[0],
          hull_shapes<3>({12, 24, 10.0}, 1, rounding, 3)[0]};
}

/// Two extreme shapes with random rotations.
template <int Dim>
struct ExtremePair {
  PlacedShape<Dim> first, second;

  ExtremePair(const std::vector<Shape<Dim>>& shapes, double scale, RandomStream& random)
      : first{&shapes[random.below(shapes.size())], 1.0, Vec<Dim>::Zero(), random_turn<Dim>(random)},
        second{&shapes[random.below(shapes.size())], scale, Vec<Dim>::Zero(), random_turn<Dim>(random)} {}

  double inner_radius() const { return std::min(first.inner_radius(), second.inner_radius()); }
};

/// Calls check(rounding, scale, shapes) for sharp, slightly rounded and strongly rounded shapes. With `scale` = 1, both
/// shapes have the same size; with 49, one shape is 49 times larger.
template <int Dim>
void for_extremes(const auto& check) {
  for (const double rounding : {0.0, 1e-6, 0.05}) {
    const std::vector<Shape<Dim>> shapes = extreme_shapes<Dim>(rounding);
    for (const double scale : {1.0, 49.0}) {
      SCOPED_TRACE(testing::Message() << Dim << " dimensions, rounding " << rounding << ", scale " << scale);
      check(rounding, scale, shapes);
    }
  }
}

template <int Dim>
void expect_gaps_of_features() {
  RandomStream random(61, 1);
  for_extremes<Dim>([&](double rounding, double scale, const std::vector<Shape<Dim>>& shapes) {
    int n_exact = 0, n = 0;
    for (const double gap : {0.3, 1e-2, 1e-4, 1e-6, -1e-6, -1e-4, -1e-2})
      for (int trial = 0; trial < 80; ++trial) {
        ExtremePair<Dim> pair(shapes, scale, random);
        const FeatureGap expected = set_gap<Dim>(pair.first, pair.second, random_direction<Dim>(random), gap);
        const Manifold<Dim> contact =
            contact_manifold<Dim>(pair.first, pair.second, std::max(0.0, expected.gap) + 1e-3);
        ASSERT_GT(contact.n(), 0) << gap;
        const double error = std::abs(contact.least_gap() - expected.gap);
        EXPECT_LT(error, 1.01e-4 * pair.inner_radius() + 1e-13 * scale) << gap;
        ++n;
        n_exact += error < 1e-13 * scale ? 1 : 0;
        // If a rounded shape touches with a face, the face normal may differ by 1e-3 radians from the line
        // between the closest points.
        if (rounding == 0.0) {
          EXPECT_NEAR(separation_along<Dim>(pair.first, pair.second, contact.normal), contact.least_gap(),
                      1e-6 * pair.inner_radius() + 1e-12 * scale)
              << gap;
        }
      }
    EXPECT_GE(n_exact, 0.97 * n);
  });
}

TEST(ManifoldExtremes, HaveTheGapsOfAllFeatures) {
  expect_gaps_of_features<2>();
  expect_gaps_of_features<3>();
}

template <int Dim>
void expect_exchange_to_keep_gaps() {
  RandomStream random(62, 1);
  for_extremes<Dim>([&](double, double scale, const std::vector<Shape<Dim>>& shapes) {
    int n_opposite = 0;
    for (int trial = 0; trial < 150; ++trial) {
      ExtremePair<Dim> pair(shapes, scale, random);
      pair.second.position = random.uniform(0.0, 1.0) *
                             (pair.first.outer_radius() + pair.second.outer_radius()) *
                             random_direction<Dim>(random);
      const Manifold<Dim> one = contact_manifold<Dim>(pair.first, pair.second, 1e3),
                          other = contact_manifold<Dim>(pair.second, pair.first, 1e3);
      ASSERT_GT(one.n(), 0);
      ASSERT_GT(other.n(), 0);
      EXPECT_NEAR(one.least_gap(), other.least_gap(), 1.01e-4 * pair.inner_radius() + 1e-13 * scale);
      n_opposite += (one.normal + other.normal).norm() < 1e-9 && one.n() == other.n() ? 1 : 0;
    }
    // Two normals may give equal gaps within the margin. The order of the shapes then decides which normal is used.
    EXPECT_GE(n_opposite, 140);
  });
}

TEST(ManifoldExtremes, KeepTheirGapsOnExchange) {
  expect_exchange_to_keep_gaps<2>();
  expect_exchange_to_keep_gaps<3>();
}

/// The smallest gap may change by at most the motion plus the margins. The margin is 1e-4 of the inner radius for
/// edges, and 1e-6 of it for faces and for rounded shapes that touch with a face. For a rounded shape that touches with
/// a face, half of 1e-6 of the distance of the cores is added.
template <int Dim>
void expect_small_motions_to_change_gaps_little() {
  RandomStream random(63, 1);
  constexpr double kStep = 2e-5, kAngle = 2e-5;
  for_extremes<Dim>([&](double, double scale, const std::vector<Shape<Dim>>& shapes) {
    for (int trial = 0; trial < 40; ++trial) {
      ExtremePair<Dim> pair(shapes, scale, random);
      set_gap<Dim>(pair.first, pair.second, random_direction<Dim>(random), 1e-3);
      const double bound = kStep + kAngle * pair.second.outer_radius() +
                           (Dim == 2 ? 3e-6 : 1.03e-4) * pair.inner_radius() + 1e-8;
      AxisFeatures last;
      double before[2] = {};
      for (int step = 0; step < 300; ++step) {
        // The second shape moves along a circle: into the first shape, along it and out of it.
        const double phase = 2.0 * std::numbers::pi * step / 300;
        pair.second.position -= kStep * std::sin(phase) * pair.second.position.normalized();
        pair.second.position += 0.5 * kStep * random_direction<Dim>(random);
        if constexpr (Dim == 2)
          pair.second.rotation = (Eigen::Rotation2Dd(kAngle).toRotationMatrix() * pair.second.rotation).eval();
        else
          pair.second.rotation =
              (Eigen::AngleAxisd(kAngle, random_direction<3>(random)).toRotationMatrix() * pair.second.rotation)
                  .eval();
        for (int k = 0; k < 2; ++k) {
          const Manifold<Dim> contact =
              contact_manifold<Dim>(pair.first, pair.second, 1e3, k == 0 ? nullptr : &last);
          ASSERT_GT(contact.n(), 0);
          if (step > 0) {
            EXPECT_NEAR(contact.least_gap(), before[k], bound + 0.5 * kStep) << trial << " " << step;
          }
          before[k] = contact.least_gap();
        }
      }
    }
  });
}

TEST(ManifoldExtremes, ChangeTheirGapsLittleInSmallMotions) {
  expect_small_motions_to_change_gaps_little<2>();
  expect_small_motions_to_change_gaps_little<3>();
}

/// Tests shapes with a common centre, shapes deep inside each other, and identical shapes at the same position.
template <int Dim>
void expect_depths_of_concentric_shapes() {
  RandomStream random(64, 1);
  for_extremes<Dim>([&](double, double scale, const std::vector<Shape<Dim>>& shapes) {
    for (int trial = 0; trial < 60; ++trial) {
      ExtremePair<Dim> pair(shapes, scale, random);
      if (trial % 3 == 1) pair.second.position = 0.3 * pair.inner_radius() * random_direction<Dim>(random);
      if (trial % 3 == 2) pair.second = pair.first;
      const Manifold<Dim> contact = contact_manifold<Dim>(pair.first, pair.second, 0.0);
      ASSERT_GT(contact.n(), 0);
      EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-14);
      const double expected =
          separation_over_axes<Dim>(pair.first, pair.second) - pair.first.rounding() - pair.second.rounding();
      EXPECT_NEAR(contact.least_gap(), expected, 1.01e-4 * pair.inner_radius() + 1e-13 * scale);
      for (int k = 0; k < contact.n(); ++k) EXPECT_TRUE(contact.points[k].arm.allFinite());
    }
  });
}

TEST(ManifoldExtremes, WithOneCentreHaveTheirDepth) {
  expect_depths_of_concentric_shapes<2>();
  expect_depths_of_concentric_shapes<3>();
}

TEST(ManifoldExtremes, RoundOnesWithOneCentreOverlapByTheirRadii) {
  const Shape<3> ball = round_shape<3>(0.5), rod = capsule<3>(20.0);
  const auto at_origin = [](const Shape<3>& shape) { return PlacedShape<3>{&shape}; };
  for (const auto& [one, other] : {std::pair(&ball, &ball), std::pair(&ball, &rod), std::pair(&rod, &rod)}) {
    const Manifold<3> contact = contact_manifold<3>(at_origin(*one), at_origin(*other), 0.0);
    ASSERT_GT(contact.n(), 0);
    EXPECT_NEAR(contact.least_gap(), -one->rounding - other->rounding, 1e-15);
    EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-15);
  }
}

/// If the reach is 0, only overlapping shapes may be in contact. This is tested for shapes of any size and at any
/// distance.
template <int Dim>
void expect_no_contact_of_shapes_apart() {
  RandomStream random(65, 1);
  for_extremes<Dim>([&](double, double scale, const std::vector<Shape<Dim>>& shapes) {
    for (const double gap : {1e-6, 1e-2, 10.0, 1e4})
      for (int trial = 0; trial < 10; ++trial) {
        ExtremePair<Dim> pair(shapes, scale, random);
        set_gap<Dim>(pair.first, pair.second, random_direction<Dim>(random), gap);
        AxisFeatures last;
        for (int step = 0; step < 3; ++step)
          EXPECT_EQ(contact_manifold<Dim>(pair.first, pair.second, 0.0, &last).n(), 0) << gap;
      }
  });
}

TEST(ManifoldExtremes, ApartHaveNoContactWithinReach0) {
  expect_no_contact_of_shapes_apart<2>();
  expect_no_contact_of_shapes_apart<3>();
}

/// Compares contacts of shapes with the size ratio 49 with closed forms: a small cube on a large plate, and a needle
/// along and across the plate.
TEST(ManifoldExtremes, OnAPlateHaveTheirClosedForms) {
  const Shape<3> plate = shape_of<3>(box_points(20, 20, 1)), needle = shape_of<3>(box_points(20, 1, 1)),
                 cube = shape_of<3>(box_points(1, 1, 1));
  RandomStream random(66, 1);
  for (int trial = 0; trial < 100; ++trial) {
    // Both bodies are rotated together; in addition, the upper body is rotated about the normal of the plate.
    const Mat<3> turn = random_turn<3>(random);
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi), gap = random.uniform(-1e-3, 1e-3);
    const Mat<3> about_z = Eigen::AngleAxisd(angle, Vec<3>::UnitZ()).toRotationMatrix();
    const auto expect_support = [&](const Shape<3>& upper, double scale, double base, int n_points,
                                    double area) {
      const PlacedShape<3> below{&plate, base, Vec<3>::Zero(), turn * plate.axes};
      const double height = 0.5 * base + 0.5 * scale + gap;
      const PlacedShape<3> above{&upper, scale, turn * Vec<3>(0.0, 0.0, height), turn * about_z * upper.axes};
      const Manifold<3> contact = contact_manifold<3>(below, above, 0.01);
      ASSERT_EQ(contact.n(), n_points);
      EXPECT_LT((contact.normal - turn * Vec<3>::UnitZ()).norm(), 1e-13);
      for (int k = 0; k < contact.n(); ++k) {
        const Vec<3> own = turn.transpose() * contact.points[k].arm;
        EXPECT_NEAR(contact.points[k].gap, gap, 1e-12);
        EXPECT_NEAR(own[2], 0.5 * base + 0.5 * gap, 1e-12);
        EXPECT_NEAR(own.head<2>().squaredNorm(), area, 1e-11);
      }
    };
    // All corners of the upper body lie over the plate of size 49 * 20, at a distance of sqrt(20^2 + 1)/2 from the
    // centre.
    expect_support(needle, 1.0, 49.0, 4, 0.25 * 401.0);
    expect_support(cube, 1.0, 49.0, 4, 0.5);
    expect_support(cube, 1.0, 1.0, 4, 0.5);
    expect_support(plate, 1.0, 49.0, 4, 200.0);
  }
}

}  // namespace
}  // namespace floc
