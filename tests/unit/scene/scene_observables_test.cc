#include "floc/scene/scene_observables.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "floc/scene/read_scene.h"
#include "floc/scene/scene_kind.h"
#include "floc/scene/scene_prices.h"
#include "support/places.h"

namespace floc::test {
namespace {

/// A shipped scene, a change of the scene, and observables that the change takes away. Without keys, the change takes
/// away the load path.
struct Change {
  std::string scene;
  std::vector<std::string> keys;
  std::vector<std::string> lost;

  Scene before() const { return read_scene(source_directory() + "/data/scenes/" + scene + ".toml"); }
  Scene after() const {
    Scene changed = read_scene(source_directory() + "/data/scenes/" + scene + ".toml", keys);
    if (keys.empty()) changed.load.clear();
    return changed;
  }
};

const std::vector<Change> kChanges = {
    {"demo", {}, {"lambda", "alpha", "Phi_max"}},
    {"demo", {"load.0.to=1e-3"}, {"lambda", "alpha", "Phi_max"}},
    {"oedometer", {}, {"K0", "M_oedometer", "lateral_ratio", "lambda", "alpha", "Phi_max"}},
    {"biaxial_dense", {}, {"stress_ratio", "peak_ratio", "critical_ratio", "dilatancy", "lateral_ratio"}},
    {"biaxial_dense", {"load.0.control=simple_shear"}, {"dilatancy", "lateral_ratio"}},
    {"constant_volume", {}, {"stress_ratio", "peak_ratio", "critical_ratio", "lateral_ratio"}},
};

TEST(SceneObservables, AreLostWithThePropertiesThatTheyNeed) {
  for (const Change& change : kChanges) {
    const Scene before = change.before(), after = change.after();
    for (const std::string& name : change.lost) {
      EXPECT_TRUE(has_observable(before, name)) << change.scene << ", " << name;
      EXPECT_FALSE(has_observable(after, name)) << change.scene << ", " << name;
    }
    EXPECT_TRUE(has_observable(after, "phi"));
  }
}

TEST(SceneObservables, PricesOfOtherObservablesAreLeftOut) {
  for (const Change& change : kChanges)
    for (const bool is_changed : {false, true}) {
      const Scene scene = is_changed ? change.after() : change.before();
      const ScenePrices prices = prices_of(scene, "");
      if (!prices.table) continue;
      for (const PriceRow& row : prices.table->rows)
        EXPECT_TRUE(has_observable(scene, row.observable)) << change.scene << ", " << row.observable;
    }
}

}  // namespace
}  // namespace floc::test
