#include "support/promises.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "floc/scene/read_scene.h"
#include "floc/scene/scene_kind.h"
#include "floc/scene/scene_prices.h"
#include "support/places.h"

// Tests of the errors that tables of prices and plans promise, for every kind of scene with a table. To run
// them alone:
//   build/release/tests/long_tests --gtest_filter='Promises.*'

namespace floc {
namespace {

/// Shipped scene of a kind, with parameters other than those used for the table of prices. The list begins with
/// the fastest scene.
struct HeldOutScene {
  const char* file;
  std::vector<std::string> changes;
};

const std::vector<HeldOutScene>& held_out_scenes() {
  static const std::vector<HeldOutScene> scenes = {
      {"compaction_demo", {"grains.count=120"}},
      {"constant_volume", {"grains.count=120", "load.0.strain=0.05", "load.0.strain_step=2.5e-3"}},
      {"cohesionless_cycle", {"grains.count=120", "load.0.steps_per_decade=2", "load.1.steps_per_decade=1"}},
      {"biaxial_dense", {"grains.count=120", "load.0.strain=0.1", "load.0.strain_step=5e-3"}},
      {"wet_demo", {"grains.count=120"}},
      {"rigid_disks_demo", {"grains.count=120"}},
      {"spheres_demo", {"grains.count=160", "load.0.to=1e6"}},
      {"type2_no_rolling", {"grains.count=150", "load.0.steps_per_decade=3", "load.1.steps_per_decade=1"}},
      {"oedometer",
       {"grains.count=120", "load.0.steps_per_decade=3", "load.1.steps_per_decade=3",
        "load.2.steps_per_decade=3"}},
      {"biaxial_cohesive", {"grains.count=120", "load.0.steps_per_decade=1", "load.1.strain_step=1e-2"}},
      {"powder3d",
       {"grains.count=120", "load.0.to=1", "load.0.steps_per_decade=2", "load.1.steps_per_decade=1"}}};
  return scenes;
}

Scene scene_of(const HeldOutScene& held) {
  return read_scene(test::source_directory() + "/data/scenes/" + held.file + ".toml", held.changes);
}

/// Returns the names of the scene's own settings and of the cheapest settings whose error in phi is below one
/// percent.
std::vector<std::string> promised_settings(const PriceTable& table) {
  for (const PricedSettings& settings : settable_prices(table))
    if (settings.parameter != "scene" && settings_error(settings, "phi") < 0.01)
      return {"scene as it is", settings.name()};
  return {"scene as it is"};
}

TEST(Promises, OfTablesAreKeptAsOftenAsTheirConfidenceSays) {
  for (const HeldOutScene& held : held_out_scenes()) {
    const Scene scene = scene_of(held);
    const ScenePrices prices = prices_of(scene, "");
    if (!prices.table) continue;
    const test::PromisesOfTable promises =
        test::count_promises(scene, *prices.table, promised_settings(*prices.table), 800, 6);
    std::printf("%s: %d of %d values of states and %d of %d means are within the promised error\n",
                scene_kind(scene).c_str(), promises.states.kept, promises.states.n, promises.means.kept,
                promises.means.n);
    std::fflush(stdout);
    EXPECT_GE(promises.states.n, 40) << held.file;
    EXPECT_GE(promises.means.n, 10) << held.file;
    EXPECT_GE(promises.states.probability(0.95), 0.01) << held.file;
    EXPECT_GE(promises.means.probability(0.95), 0.01) << held.file;
  }
}

TEST(Promises, OfPlansAreKeptInErrorAndInCost) {
  int n_plans = 0;
  test::KeptPromises errors;
  for (const HeldOutScene& held : held_out_scenes()) {
    const Scene scene = scene_of(held);
    const ScenePrices prices = prices_of(scene, "");
    if (!prices.table || n_plans == 9) continue;
    const PriceModel model(scene, prices.table, run_pilot(scene, 600.0));
    for (const double budget : {5.0, 15.0, 45.0}) {
      ++n_plans;
      for (const test::PlanOutcome& outcome :
           test::outcome_of_plan(scene, model, budget, studied_settings(scene)[0])) {
        std::printf("%s, budget %g s, %s: promised %.2g, achieved %.2g; cost promised %.3g s, actual %.3g s\n",
                    scene_kind(scene).c_str(), budget, outcome.observable.c_str(), outcome.promised,
                    outcome.achieved, outcome.promised_seconds, outcome.seconds);
        errors.add(outcome.achieved <= 1.2 * outcome.promised);
        EXPECT_LE(outcome.seconds, 1.5 * outcome.promised_seconds) << held.file;
        EXPECT_GE(outcome.seconds, outcome.promised_seconds / 1.5) << held.file;
      }
    }
  }
  EXPECT_GE(errors.kept * 9, errors.n * 8) << errors.kept << " of " << errors.n;
}

}  // namespace
}  // namespace floc
