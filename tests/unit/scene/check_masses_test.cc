#include "floc/scene/check_masses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "floc/base/error.h"
#include "floc/scene/read_scene.h"
#include "support/message_of.h"
#include "support/places.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::filesystem::path scene_file(const std::string& name) {
  return test::source_directory() + "/data/scenes/" + name + ".toml";
}

/// Returns the message with which a scene is refused if its grains get equal masses; empty if it is accepted.
std::string refusal(const std::filesystem::path& file, std::vector<std::string> changes = {}) {
  changes.emplace_back("equilibrium.masses=equal");
  return test::message_of(
      [&] { EXPECT_TRUE(read_scene(file.string(), changes).relaxation.equal_masses) << file; });
}

TEST(CheckMasses, EveryShippedSceneHasEqualMassesOrSaysWhyNot) {
  int n_accepted = 0, n_refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_directory() + "/data/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const Scene scene = read_scene(entry.path().string(), {});
    EXPECT_FALSE(scene.relaxation.equal_masses) << entry.path();
    const std::string message = refusal(entry.path());
    if (allows_equal_masses(scene)) {
      EXPECT_THAT(message, IsEmpty()) << entry.path();
    } else {
      EXPECT_THAT(message, HasSubstr("equilibrium.masses")) << entry.path();
    }
    ++(message.empty() ? n_accepted : n_refused);
  }
  EXPECT_GT(n_accepted, 10);
  EXPECT_GT(n_refused, 3);
}

TEST(CheckMasses, WeightsNeedOwnMasses) {
  const std::string walls = "box.boundary={x=\"periodic\", y=\"periodic\", z=\"floor\"}";
  EXPECT_THAT(refusal(scene_file("compaction_demo")), IsEmpty());
  EXPECT_THAT(refusal(scene_file("compaction_demo"), {walls, "box.gravity=[0,0,-1e-3]"}),
              HasSubstr("equilibrium.masses = \"equal\" is not allowed here: the weights of the grains"));
}

TEST(CheckMasses, AccuracyChoosesTheMasses) {
  EXPECT_THAT(refusal(scene_file("demo"), {"accuracy.phi=0.01"}),
              HasSubstr("equilibrium.masses is chosen by [accuracy]"));
}

TEST(CheckMasses, OtherWordsAreRefused) {
  EXPECT_THROW((void)read_scene(scene_file("demo").string(), {"equilibrium.masses=heavy"}), InputError);
}

}  // namespace
}  // namespace floc
