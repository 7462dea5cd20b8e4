#include "floc/scene/derived_groups.h"

#include <gtest/gtest.h>

#include <cmath>

#include "floc/scene/read_scene.h"
#include "floc/scene/starting_scene.h"
#include "support/places.h"

namespace floc {
namespace {

Scene shipped(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_scene(test::source_directory() + "/data/scenes/" + name + ".toml", overrides);
}

double group(const Scene& scene, const std::string& name) {
  for (const DerivedGroup& g : derived_groups(scene))
    if (g.name == name) return g.value;
  return std::nan("");
}

TEST(DerivedGroups, DoNotDependOnTheUnitsOfAScene) {
  const Scene scene = shipped("demo");
  // The scene in other units: lengths are doubled and forces tripled. The mass density still gives m = 1 at d = a.
  const Scene other =
      shipped("demo", {"grains.diameter.min=1", "grains.diameter.max=2", "grains.density=0.3183098861837907",
                       "contact.adhesion.force=3", "contact.adhesion.range=2e-3",
                       "contact.normal.stiffness=1.5e5", "contact.friction.stiffness=1.5e5",
                       "contact.rolling.coefficient=0.01", "contact.rolling.stiffness=60",
                       "assembly.pressure=0.015", "load.0.to=19.995", "load.1.to=0.015"});
  const auto expected = derived_groups(scene);
  const auto found = derived_groups(other);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(expected[i].name, found[i].name);
    if (expected[i].name == "T0" || expected[i].name == "time_step") {
      EXPECT_NEAR(found[i].value / expected[i].value, std::sqrt(2.0 / 3.0), 1e-12) << expected[i].name;
    } else {
      EXPECT_NEAR(found[i].value, expected[i].value, 1e-12 * std::abs(expected[i].value)) << expected[i].name;
    }
  }
}

TEST(DerivedGroups, PhysicsLeftOutHasNoGroup) {
  EXPECT_TRUE(std::isnan(group(shipped("type2_no_rolling"), "mu_R/a")));
  EXPECT_TRUE(std::isnan(group(shipped("cohesionless_cycle"), "P_star")));
  EXPECT_NEAR(group(shipped("cohesionless_cycle"), "kappa"), 1e5, 1e-9);
  EXPECT_TRUE(std::isnan(group(shipped("type1_no_rolling"), "V0/V_star")));
}

TEST(DerivedGroups, LargeRollingStiffnessShortensTheTimeStep) {
  EXPECT_LT(group(shipped("type2_rolling_large"), "time_step"),
            0.5 * group(shipped("type2_no_rolling"), "time_step"));
}

/// Processor times of the shipped examples of rigid grains, measured on one core of the year 2025.
TEST(ExpectedCost, OfRigidGrainsIsThatMeasured) {
  for (const auto& [name, seconds] : {std::pair("rigid_disks_demo", 2.0),
                                      {"disks_shear_demo", 1.9},
                                      {"pentagons_demo", 1.9},
                                      {"pentagons_box_demo", 5.7},
                                      {"pentagons_shear_demo", 7.7},
                                      {"polyhedra_demo", 25.0}}) {
    const double ratio = expected_cost(shipped(name)) / seconds;
    EXPECT_GT(ratio, 0.5) << name;
    EXPECT_LT(ratio, 2.0) << name;
  }
}

TEST(ExpectedCost, GrowsWithGrainsAndIsCheaperDownwards) {
  EXPECT_NEAR(expected_cost(shipped("demo", {"grains.count=800"})) / expected_cost(shipped("demo")), 2.0,
              1e-12);
  const std::vector<std::string> up_again = {"load.1.to=17770", "load.1.steps_per_decade=4"};
  EXPECT_GT(expected_cost(shipped("demo", up_again)), expected_cost(shipped("demo")));
}

TEST(StartingScene, IsTheDemoUnderItsOwnName) {
  const Scene scene = parse_scene(starting_scene("mine"), "mine.toml", ".");
  const Scene demo = shipped("demo");
  EXPECT_EQ(scene.name, "mine");
  EXPECT_EQ(scene.law, demo.law);
  EXPECT_EQ(scene.grains.count, demo.grains.count);
}

}  // namespace
}  // namespace floc
