#include <gtest/gtest.h>

#include "support/kill_and_resume.h"
#include "support/places.h"
#include "support/threaded_run.h"

namespace floc::test {
namespace {

/// The small scene, with springs that are ten times softer while grains rearrange.
std::string scene_on_soft_springs() {
  return small_scene() + "[equilibrium]\nsoftening = 10\n";
}

TEST(SoftRun, SurvivesKillsWithoutATrace) {
  kill_and_resume(10, 31, scene_on_soft_springs());
}

TEST(SoftRun, ThreadsLeaveNoTrace) {
  expect_no_trace_of_threads(scene_on_soft_springs());
}

TEST(SoftRun, WritesEquilibriaThatVerifyPassesAndItsOwnScene) {
  const ScratchDirectory scratch;
  write_text(scratch.file("small.toml"), scene_on_soft_springs());
  ASSERT_EQ(run_floc("run small.toml -o run", scratch.path()).code, 0);
  const Outcome verified = run_floc("verify run/state-*.h5", scratch.path());
  EXPECT_EQ(verified.code, 0) << verified.out;
  const Outcome scene = run_floc("info run/state-0008.h5 --scene", scratch.path());
  EXPECT_NE(scene.out.find("softening = 10"), std::string::npos) << scene.out;
}

TEST(SoftRun, KeepsNoAccountOfEnergy) {
  const ScratchDirectory scratch;
  write_text(scratch.file("small.toml"), scene_on_soft_springs() + "finish = \"dynamic\"\n");
  const Outcome refused = run_floc("run small.toml -o run --track-energy", scratch.path());
  EXPECT_EQ(refused.code, 4);
  EXPECT_NE(refused.err.find("softer springs"), std::string::npos) << refused.err;
}

/// During a collapse on softened springs, contacts are tracked as in any other motion.
TEST(SoftRun, TracksContacts) {
  const ScratchDirectory scratch;
  write_text(scratch.file("small.toml"), scene_on_soft_springs());
  const Outcome made = run_floc("run small.toml -o run --track-contacts 0.1", scratch.path());
  EXPECT_EQ(made.code, 0) << made.err;
}

}  // namespace
}  // namespace floc::test
