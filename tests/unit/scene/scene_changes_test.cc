#include "floc/scene/scene_changes.h"

#include <gtest/gtest.h>

#include <string>

namespace floc {
namespace {

const std::string kTwoStages =
    "[grains]\ncount = 40\n[[load]]\nto = 1.0\nsteps = 2\n[[load]]\nstrain = 0.1\nstrain_step = 0.01\n";

std::string exchanged(const std::string& old, const std::string& now) {
  std::string text = kTwoStages;
  return text.replace(text.find(old), old.size(), now);
}

TEST(ContinuesPath, HoldsForALongerLastStageAndForFurtherStages) {
  EXPECT_TRUE(continues_path(exchanged("strain = 0.1", "strain = 0.2"), kTwoStages));
  EXPECT_TRUE(continues_path(kTwoStages + "[[load]]\nto = 3.0\n", kTwoStages));
  EXPECT_TRUE(continues_path("# a comment\n" + exchanged("strain = 0.1", "strain = 0.2"), kTwoStages));
  // A scene without stages can be continued with any stages.
  EXPECT_TRUE(continues_path("[grains]\ncount = 40\n[[load]]\nto = 1.0\n", "[grains]\ncount = 40\n"));
}

TEST(ContinuesPath, FailsForAnyOtherChange) {
  EXPECT_FALSE(continues_path(kTwoStages, kTwoStages));
  EXPECT_FALSE(continues_path("# a comment\n" + kTwoStages, kTwoStages));
  for (const auto& [old, now] : {std::pair{"count = 40", "count = 41"},
                                 {"to = 1.0", "to = 2.0"},
                                 {"steps = 2", "steps = 3"},
                                 {"strain_step = 0.01", "strain_step = 0.02"},
                                 {"strain = 0.1", "to = 2.0"},
                                 {"strain = 0.1", "strain = 0.1\naxis = 1"}})
    EXPECT_FALSE(continues_path(exchanged(old, now), kTwoStages)) << now;
  EXPECT_FALSE(continues_path(exchanged("count = 40", "count = 41") + "[[load]]\nto = 3.0\n", kTwoStages));
  // A path with fewer stages does not continue a path with more stages.
  EXPECT_FALSE(continues_path(kTwoStages, kTwoStages + "[[load]]\nto = 3.0\n"));
}

}  // namespace
}  // namespace floc
