#include <gtest/gtest.h>

#include "floc/scene/read_scene.h"
#include "floc/scene/scene_prices.h"
#include "support/places.h"
#include "support/promises.h"

// Smaller versions of the tests in tests/long/promises_test.cc.
namespace floc {
namespace {

Scene small_scene() {
  return read_scene(test::source_directory() + "/data/scenes/type1_rolling_small.toml",
                    {"grains.count=60", "load.0.to=0.1", "load.0.steps_per_decade=2"});
}

TEST(Promise, OfTheTableIsKeptByOtherSeeds) {
  const Scene scene = small_scene();
  const test::PromisesOfTable promises =
      test::count_promises(scene, *prices_of(scene, "").table, {"scene as it is", "together fine"}, 700, 3);
  EXPECT_GE(promises.states.n, 40);
  EXPECT_GE(promises.means.n, 10);
  EXPECT_GE(promises.states.probability(0.95), 0.01) << promises.states.kept << " of " << promises.states.n;
  EXPECT_GE(promises.means.probability(0.95), 0.01) << promises.means.kept << " of " << promises.means.n;
}

TEST(Promise, OfAPlanIsKept) {
  const Scene scene = small_scene();
  PriceModel model(scene, prices_of(scene, "").table);
  model.remove_settings([](const PricedSettings&) { return true; });
  for (const test::PlanOutcome& outcome :
       test::outcome_of_plan(scene, model, 1.5, test::studied(scene, "scene as it is")))
    EXPECT_LE(outcome.achieved, 1.2 * outcome.promised) << outcome.observable;
}

TEST(Promise, IsCountedByTheBinomialDistribution) {
  const test::KeptPromises all{20, 20}, most{20, 19}, few{20, 12};
  EXPECT_NEAR(all.probability(0.95), 1.0, 1e-12);
  EXPECT_NEAR(most.probability(0.95), 1.0 - std::pow(0.95, 20), 1e-12);
  EXPECT_LT(few.probability(0.95), 1e-5);
}

}  // namespace
}  // namespace floc
