#include "floc/scene/cost_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "floc/base/error.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_prices.h"
#include "support/places.h"

namespace floc {
namespace {

Scene priced_scene(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_scene(test::source_directory() + "/data/scenes/" + name + ".toml", overrides);
}

double cost_seconds(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return cost_of_run(priced_scene(name, overrides)).core_seconds;
}

double row_seconds(const PriceTable& table, const std::string& parameter, const std::string& value) {
  return table.find(parameter, value, "phi")->core_seconds;
}

TEST(CostOfARun, IsThatOfTheTableOfPricesWhereOneApplies) {
  for (const char* name : {"demo", "compaction", "polyhedra_demo", "rigid_disks_demo"}) {
    const Scene scene = priced_scene(name);
    const RunCost cost = cost_of_run(scene);
    ASSERT_TRUE(cost.is_priced()) << name;
    const ScenePrices prices = prices_of(scene, "");
    const CostModel model(scene, *prices.table);
    EXPECT_EQ(cost.core_seconds, model.core_seconds(model.settings_of_scene(), scene.grains.count)) << name;
    EXPECT_EQ(derived_groups(scene).back().name, "cost");
    EXPECT_EQ(derived_groups(scene).back().value, cost.core_seconds) << name;
    EXPECT_THAT(derived_groups(scene).back().meaning,
                testing::HasSubstr("by the table of prices of the kind "));
  }
}

TEST(CostOfARun, IsARoughEstimateWhereNoTableApplies) {
  const Scene stiff = priced_scene("demo", {"contact.normal.stiffness=1e9"});
  const RunCost cost = cost_of_run(stiff);
  EXPECT_FALSE(cost.is_priced());
  EXPECT_EQ(cost.core_seconds, expected_cost(stiff));
  EXPECT_THAT(derived_groups(stiff).back().meaning, testing::HasSubstr("roughly"));
  const std::string beads = test::source_directory() + "/data/tables/tradeoff/beads-hertz.csv";
  EXPECT_THROW((void)cost_of_run(stiff, beads), InputError) << "a table that the user names has to apply";
}

TEST(CostOfARun, FollowsTheSettingsOfRigidGrains) {
  const PriceTable table = *prices_of(priced_scene("polyhedra_demo"), "").table;
  const double plain = cost_seconds("polyhedra_demo"), scene = row_seconds(table, "scene", "as it is");
  for (const char* value : {"1e-01", "1e-02", "1e-04"})
    EXPECT_NEAR(cost_seconds("polyhedra_demo", {std::string("dynamics.sweep_tolerance=") + value}) / plain,
                row_seconds(table, "sweep_tolerance", value) / scene, 1e-9)
        << value;
  for (const char* value : {"0.025", "0.1"})
    EXPECT_NEAR(cost_seconds("polyhedra_demo", {std::string("dynamics.time_step=") + value}) / plain,
                row_seconds(table, "time_step", value) / scene, 1e-9)
        << value;
  EXPECT_NEAR(cost_seconds("polyhedra_demo", {"dynamics.finish=canonical"}) / plain,
              row_seconds(table, "finish", "canonical") / scene, 1e-9);
  // Values between those of the table are interpolated by power laws.
  EXPECT_NEAR(cost_seconds("polyhedra_demo", {"dynamics.sweep_tolerance=0.00031622776601683794"}) / plain,
              std::sqrt(row_seconds(table, "sweep_tolerance", "1e-04") / scene), 1e-9);
}

TEST(CostOfARun, FollowsTheTimeStepsOfParts) {
  const double plain = cost_seconds("spheres_demo");
  EXPECT_NEAR(cost_seconds("spheres_demo", {"assembly.time_step=0.72"}) / plain, 0.57 / 2.0 + 0.43, 1e-12);
  EXPECT_NEAR(cost_seconds("spheres_demo", {"load.1.time_step=0.09"}) / plain, 0.57 + 0.43 * (1.0 + 4.0) / 2.0,
              1e-12);
}

TEST(CostOfARun, FollowsTheSettingsThatAccuracyChooses) {
  const PriceTable table = *prices_of(priced_scene("demo"), "").table;
  const std::vector<std::string> wanted = {"accuracy.phi=0.001", "accuracy.moduli=0.05"};
  const Scene chosen = priced_scene("demo", wanted);
  const std::string name = chosen.accuracy.substr(0, chosen.accuracy.find(':'));
  double expected = 0.0;
  for (const PriceRow& row : table.rows)
    if (row.observable == "phi" && row.parameter + " " + row.value == name) expected = row.core_seconds;
  ASSERT_GT(expected, 0.0) << name;
  EXPECT_NEAR(cost_of_run(chosen).core_seconds / cost_seconds("demo"),
              expected / row_seconds(table, "scene", "as it is"), 1e-9)
      << name;
}

}  // namespace
}  // namespace floc
