#include "floc/scene/check_time_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "floc/scene/read_scene.h"
#include "support/message_of.h"
#include "support/places.h"

namespace floc {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

std::string shipped_file(const std::string& name) {
  return test::source_directory() + "/data/scenes/" + name + ".toml";
}

/// Returns the message with which a scene is refused after changes; empty if it is accepted.
std::string refusal_of_step(const std::string& file, const std::vector<std::string>& changes) {
  return test::message_of([&] { (void)read_scene(file, changes); });
}

TEST(CheckTimeSteps, PartsOfEveryShippedSceneHaveTheirOwnStepOrAMessageSaysWhyNot) {
  int n_accepted = 0, n_refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_directory() + "/data/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string file = entry.path().string();
    const Scene scene = read_scene(file, {});
    EXPECT_FALSE(scene.assembly.cell.time_step.has_value()) << file;
    std::vector<std::string> keys = {"assembly.time_step"};
    if (!scene.load.empty()) keys.emplace_back("load.0.time_step");
    for (const std::string& key : keys) {
      const std::string message = refusal_of_step(file, {key + "=0.3"});
      if (scene.assembly.box || scene.has_contact_dynamics()) {
        EXPECT_THAT(message, HasSubstr(key + " is not allowed here")) << file;
      } else {
        EXPECT_THAT(message, IsEmpty()) << file;
        EXPECT_THAT(refusal_of_step(file, {key + "=0.8"}),
                    HasSubstr(key + " = 0.8: expected a number in (0, 0.8)"))
            << file;
      }
      ++(message.empty() ? n_accepted : n_refused);
    }
  }
  EXPECT_GT(n_accepted, 20);
  EXPECT_GT(n_refused, 5);
}

TEST(CheckTimeSteps, OnlyGrainsThatNeitherRubNorRollHaveLongSteps) {
  const std::string kReason = "expected a number below 0.4, because grains with friction";
  EXPECT_THAT(refusal_of_step(shipped_file("spheres_a"), {"assembly.time_step=0.79"}), IsEmpty());
  EXPECT_THAT(refusal_of_step(shipped_file("spheres_d"), {"assembly.time_step=0.4"}),
              AllOf(HasSubstr("assembly.time_step = 0.4"), HasSubstr(kReason)));
  EXPECT_THAT(refusal_of_step(shipped_file("spheres_d"), {"assembly.time_step=0.39"}), IsEmpty());
  EXPECT_THAT(refusal_of_step(shipped_file("spheres_d"), {"assembly.friction=0", "assembly.time_step=0.5"}),
              IsEmpty());
  // Friction acts on the load path, and only one of its two stages is at fault.
  EXPECT_THAT(
      refusal_of_step(shipped_file("spheres_a"), {"load.1.time_step=0.5"}),
      AllOf(HasSubstr("load.1.time_step = 0.5"), HasSubstr(kReason), testing::Not(HasSubstr("load.0"))));
  EXPECT_THAT(
      refusal_of_step(shipped_file("type2_rolling_small"), {"assembly.friction=0", "assembly.time_step=0.5"}),
      HasSubstr("resistance to rolling"));
  EXPECT_THAT(refusal_of_step(shipped_file("demo"), {"accuracy.phi=0.01", "assembly.time_step=0.3"}),
              HasSubstr("assembly.time_step is not allowed here: the time step is chosen by [accuracy]"));
}

TEST(CheckTimeSteps, APartWithoutItsOwnStepHasThatOfTheRun) {
  const Scene scene = read_scene(shipped_file("spheres_a"), {"run.time_step=0.3", "assembly.time_step=0.7"});
  EXPECT_EQ(scene.assembly.cell.applied_to(scene.relaxation).time_step, 0.7);
  for (const LoadStage& stage : scene.load)
    EXPECT_EQ(stage.cell.applied_to(scene.relaxation).time_step, 0.3) << stage.name;
}

}  // namespace
}  // namespace floc
