#include <gtest/gtest.h>

#include "support/random_rigid_scenes.h"

/// Tests of relaxations of rigid grains with one parameter at an end of its range.
namespace floc::test {
namespace {

TEST(RigidGrains, RandomScenesEndAtRestOrWithAReason) {
  relax_random_scenes(20, 1);
  // In the last step of this scene, adhesion pulls across a gap where impacts are elastic.
  relax_random_scenes(1, 39);
}

TEST(RigidGrains, SizesFromOneToFortyNine) {
  expect_at_rest(relaxed(make_rigid_gas<2>({.count = 100, .least = 1.0 / 49.0, .friction = 0.5})));
}

TEST(RigidGrains, Needles) {
  for (const ShapeOptions& shape :
       {ShapeOptions{.kind = CapsuleOptions{20.0}}, ShapeOptions{.kind = BoxShapeOptions{{19.0, 1.0}}}})
    expect_at_rest(relaxed(make_rigid_gas<2>({.count = 20, .shape = shape, .friction = 0.5}), rigid_options(),
                           false, 6000));
}

TEST(RigidGrains, Plates) {
  const ShapeOptions shape{.kind = BoxShapeOptions{{10.0, 10.0, 1.0}}};
  expect_at_rest(
      relaxed(make_rigid_gas<3>({.count = 10, .shape = shape, .friction = 0.5}), rigid_options(), false, 6000));
}

TEST(RigidGrains, LargeFriction) {
  expect_at_rest(relaxed(make_rigid_gas<2>({.count = 60, .friction = 2.0})));
}

TEST(RigidGrains, TwoGrains) {
  for (const double friction : {0.0, 0.5})
    expect_at_rest(relaxed(make_rigid_gas<2>({.count = 2, .friction = friction})));
}

TEST(RigidGrains, TinyRounding) {
  const ShapeOptions shape{.kind = PolygonOptions{5}, .rounding = 1e-6};
  expect_at_rest(relaxed(make_rigid_gas<2>({.count = 40, .shape = shape, .friction = 0.5})));
}

TEST(RigidGrains, StrongAdhesion) {
  expect_at_rest(relaxed(make_rigid_gas<2>({.count = 40, .friction = 0.5, .adhesion = 10.0})));
}

}  // namespace
}  // namespace floc::test
