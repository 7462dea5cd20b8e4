#include "support/elastic_gas.h"
#include "support/isostatic.h"
#include "support/kill_and_resume.h"
#include "support/random_rigid_scenes.h"
#include "support/rigid_run.h"

namespace floc::test {
namespace {

TEST(RigidGrains, TwoHundredRandomScenesEndAtRestOrWithAReason) {
  relax_random_scenes(200, 1);
}

TEST(RigidGrains, TwoHundredFrictionlessPentagonsAreNearlyIsostatic) {
  for (const std::uint64_t seed : {1u, 2u})
    expect_nearly_isostatic<2>({.kind = PolygonOptions{5}}, 200, seed, 0.95);
}

TEST(RigidGrains, TwoHundredFrictionlessPolyhedraAreNearlyIsostatic) {
  for (const std::uint64_t seed : {1u, 2u}) expect_nearly_isostatic<3>({.kind = CutOptions{}}, 200, seed, 0.98);
}

TEST(RigidGrains, ModuliOfSixtyElasticPolyhedraAreThoseOfRelaxedStrains) {
  expect_moduli_of_strains<3>(60, {.kind = CutOptions{}, .rounding = 0.05}, 0.5, 2e-4);
}

/// The seed 1 is left out: a grain that hardly fits between two others comes into contact with both under the smallest
/// change of the pressure, so that no step of the differences is small enough.
TEST(RigidGrains, ModuliOfThreeHundredElasticPolyhedraAreThoseOfRelaxedStrains) {
  for (const std::uint64_t seed : {2u, 3u})
    expect_moduli_of_strains<3>(300, {.kind = CutOptions{}, .rounding = 0.3}, 0.5, 2e-4, seed);
}

TEST(RigidGrains, ThirtyKillsLeaveNoTrace) {
  kill_and_resume(30, 23, rigid_scene(""), 4);
  kill_and_resume(30, 24, rigid_scene(kPentagons), 4);
}

}  // namespace
}  // namespace floc::test
