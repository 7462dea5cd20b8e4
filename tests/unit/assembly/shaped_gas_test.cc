#include "floc/assembly/shaped_gas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "floc/assembly/draw_shapes.h"
#include "floc/base/error.h"
#include "floc/neighbors/pairs.h"
#include "support/contact_laws.h"

namespace floc {
namespace {

GrainOptions grains_with(const ShapeOptions& shape, int count = 60) {
  GrainOptions grains;
  grains.count = count;
  grains.diameter.min = 0.5;
  grains.diameter.max = 1.0;
  grains.shape = shape;
  return grains;
}

ShapeOptions pentagons() {
  return {PolygonOptions{5}, 0.0, 1};
}
ShapeOptions cut(int count = 7) {
  return {CutOptions{}, 0.0, count};
}

template <int Dim>
Packing<Dim> gas_of(const GrainOptions& grains, double solid_fraction, std::uint64_t seed = 1) {
  RandomStream random(seed, 1);
  return make_shaped_gas<Dim>(grains, test::cohesive_law(), solid_fraction, seed, random,
                              GasKind::sequential_addition);
}

TEST(ShapedGas, HasTheSolidFractionOfTheGrainsThemselves) {
  for (const double phi : {0.05, 0.3, 0.45}) {
    const Packing<2> gas = gas_of<2>(grains_with(pentagons()), phi);
    EXPECT_NEAR(solid_fraction(gas), phi, 1e-13);
    // Grains whose circumscribed circles do not overlap cannot overlap in any orientation.
    EXPECT_TRUE(find_pairs(gas.cell, gas.grains, 0.0).empty()) << phi;
  }
  for (const double phi : {0.05, 0.12})
    EXPECT_NEAR(solid_fraction(gas_of<3>(grains_with(cut()), phi)), phi, 1e-13);
}

TEST(ShapedGas, RadiusIsHalfTheDiameterAndTheScaledOuterRadius) {
  const Packing<3> gas = gas_of<3>(grains_with(cut()), 0.1);
  const Grains<3>& g = gas.grains;
  const auto [low, high] = std::minmax_element(g.radius.begin(), g.radius.end());
  EXPECT_DOUBLE_EQ(*low, 0.25);
  EXPECT_DOUBLE_EQ(*high, 0.5);
  for (int i = 0; i < g.size(); ++i)
    EXPECT_DOUBLE_EQ(g.radius[i], g.scale[i] * (*g.shapes)[g.shape[i]].outer_radius) << i;
}

TEST(ShapedGas, MassIsDensityTimesVolume) {
  GrainOptions grains = grains_with(pentagons());
  const auto mass_over_volume = [&](int i) {
    const Grains<2> g = gas_of<2>(grains, 0.2).grains;
    return g.mass[i] / g.volume(i);
  };
  // If the scene gives no density, a disk of diameter 1 has the mass 1.
  EXPECT_DOUBLE_EQ(mass_over_volume(3), 4.0 / std::numbers::pi);
  grains.density = 7.0;
  EXPECT_DOUBLE_EQ(mass_over_volume(3), 7.0);
  // The area of a regular pentagon, divided by the area of its circumscribed circle, is 5 sin(72 degrees)/(2
  // pi).
  const Grains<2> g = gas_of<2>(grains, 0.2).grains;
  EXPECT_NEAR(share_of_bounding_balls(g), 2.5 * std::sin(0.4 * std::numbers::pi) / std::numbers::pi, 1e-14);
}

TEST(ShapedGas, EveryShapeIsDealtOutEquallyOften) {
  const Packing<3> gas = gas_of<3>(grains_with(cut(7), 60), 0.1);
  ASSERT_EQ(gas.grains.shapes->size(), 7u);
  std::vector<int> times(7, 0);
  for (const int s : gas.grains.shape) ++times[s];
  for (const int n : times) {
    EXPECT_GE(n, 8);
    EXPECT_LE(n, 9);
  }
  // Shapes are assigned in random order, not one after the other.
  EXPECT_FALSE(std::is_sorted(gas.grains.shape.begin(), gas.grains.shape.begin() + 7));
}

TEST(ShapedGas, OrientationsAreUniform) {
  GrainOptions grains = grains_with(cut(1), 4000);
  const std::vector<double> diameter(4000, 1.0);
  const Grains<3> g = shaped_grains<3>(grains, diameter, 5);
  // An axis of a randomly rotated grain is a random unit vector with a uniform distribution on the sphere. The mean of
  // this vector is zero, and the mean of its dyadic product is 1/3 of the unit matrix. The standard errors of the means
  // are sqrt(1/3)/sqrt(4000) = 0.009 and 0.005.
  for (int axis = 0; axis < 3; ++axis) {
    Vec<3> mean = Vec<3>::Zero();
    Mat<3> second = Mat<3>::Zero();
    for (const auto& q : g.orientation) {
      EXPECT_NEAR(q.norm(), 1.0, 1e-15);
      const Vec<3> u = rotation_matrix(q).col(axis);
      mean += u / g.size(), second += u * u.transpose() / g.size();
    }
    EXPECT_LT(mean.norm(), 0.05);
    EXPECT_LT((second - Mat<3>::Identity() / 3.0).norm(), 0.05);
  }
  const Grains<2> flat = shaped_grains<2>(grains_with(pentagons(), 4000), diameter, 5);
  Vec<2> mean = Vec<2>::Zero();
  for (const double angle : flat.orientation) mean += Vec<2>(std::cos(angle), std::sin(angle)) / flat.size();
  EXPECT_LT(mean.norm(), 0.05);
}

TEST(ShapedGas, SeedDecidesEverything) {
  const GrainOptions grains = grains_with(cut());
  const Packing<3> a = gas_of<3>(grains, 0.1, 3), b = gas_of<3>(grains, 0.1, 3), c = gas_of<3>(grains, 0.1, 4);
  EXPECT_EQ(a.grains.position, b.grains.position);
  EXPECT_EQ(a.grains.shape, b.grains.shape);
  EXPECT_EQ((*a.grains.shapes)[0].vertices, (*b.grains.shapes)[0].vertices);
  for (int i = 0; i < a.grains.size(); ++i)
    EXPECT_EQ(a.grains.orientation[i].coeffs(), b.grains.orientation[i].coeffs());
  EXPECT_NE(a.grains.position, c.grains.position);
  EXPECT_NE(a.grains.shape, c.grains.shape);
  EXPECT_NE((*a.grains.shapes)[0].vertices, (*c.grains.shapes)[0].vertices);
}

TEST(ShapedGas, TooDenseForTheCircumscribedBallsIsRefusedWithTheLargestValue) {
  EXPECT_THAT([] { (void)gas_of<2>(grains_with(pentagons()), 0.5); },
              testing::ThrowsMessage<InputError>(testing::AllOf(testing::HasSubstr("cell.solid_fraction: 0.5"),
                                                                testing::HasSubstr("0.4541"))));
}

TEST(DrawShapes, AllKindsHaveTheDiameterOne) {
  const auto check = []<int Dim>(const std::vector<Shape<Dim>>& shapes, std::size_t n) {
    EXPECT_EQ(shapes.size(), n);
    for (const Shape<Dim>& shape : shapes) EXPECT_NEAR(shape.diameter(), 1.0, 1e-14);
  };
  check(draw_shapes<2>({PolygonOptions{6}, 0.1, 1}, 1).shapes, 1);
  check(draw_shapes<2>({BoxShapeOptions{{1.0, 2.0}}, 0.0, 1}, 1).shapes, 1);
  check(draw_shapes<3>({BoxShapeOptions{{1.0, 2.0, 3.0}}, 0.2, 1}, 1).shapes, 1);
  check(draw_shapes<3>({HullOptions{}, 0.0, 5}, 1).shapes, 5);
  check(draw_shapes<2>({HullOptions{}, 0.0, 5}, 1).shapes, 5);
  check(draw_shapes<3>({CutOptions{}, 0.05, 5}, 1).shapes, 5);
  check(draw_shapes<3>({VoronoiOptions{20, 1}, 0.0, 5}, 1).shapes, 5);
  check(draw_shapes<2>({CapsuleOptions{3.0}, 0.0, 1}, 1).shapes, 1);
}

TEST(DrawShapes, ShapesOfAnotherDimensionAreRefused) {
  EXPECT_THROW((void)draw_shapes<3>(pentagons(), 1), InputError);
  EXPECT_THROW((void)draw_shapes<2>({BoxShapeOptions{{1.0, 2.0, 3.0}}, 0.0, 1}, 1), InputError);
}

}  // namespace
}  // namespace floc
