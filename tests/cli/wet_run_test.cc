#include <gtest/gtest.h>

#include <string>

#include "support/kill_and_resume.h"
#include "support/scene_text.h"
#include "support/threaded_run.h"
#include "support/wet_scene.h"

namespace floc::test {
namespace {

void expect_rest(const std::string& options) {
  const ScratchDirectory scratch;
  const Outcome made = run_floc("run " + source_directory() +
                                    "/data/scenes/wet_demo.toml --set assembly.friction=0.4 "
                                    "--set equilibrium.max_time=400 --until 1 -o out " +
                                    options,
                                scratch.path());
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome verified = run_floc("verify out/state-*.h5", scratch.path());
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

/// One grain has few contacts, and only its liquid bridges keep it in place. With the geometric terms of the capillary
/// forces, this state is a minimum of the energy. Without these terms, it would be a saddle point.
TEST(WetRun, ComesToRestWhereTheirPullAloneHoldsAGrain) {
  expect_rest("--seed 1");
}

/// One grain has two nearly opposite contacts. Only the geometric terms of the tangential forces make its rotation
/// about the line through both contacts stable.
TEST(WetRun, ComesToRestWhereFrictionHoldsASpin) {
  expect_rest("--seed 45 --set equilibrium.finish=dynamic");
}

/// Nothing resists a change of the height of a bed under a free surface. With the terms of the capillary forces, this
/// strain must not count as a direction in which the bed is unstable.
TEST(WetRun, BedOnAFloorComesToRest) {
  const ScratchDirectory scratch;
  std::string scene = exchanged(scene_text("wet"), "water_content = 0", "water_content = 0.007");
  scene.resize(scene.find("[cell]"));
  scene += R"([assembly]
protocol = "direct"
[box]
sides = [6e-3, 6e-3, 2e-2]
boundary = {x = "periodic", y = "periodic", z = "floor"}
gravity = [0, 0, -9.81]
friction = 0.4
adhesion = 0
[equilibrium]
max_time = 400
)";
  write_text(scratch.file("bed.toml"), scene);
  const Outcome made = run_floc("run bed.toml -o out", scratch.path());
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome verified = run_floc("verify out", scratch.path());
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

TEST(WetRun, GivesTheSameFilesForTwoThreads) {
  const ScratchDirectory scratch;
  write_text(scratch.file("wet.toml"), wet_scene());
  ASSERT_EQ(run_floc("run wet.toml -o one", scratch.path()).code, 0);
  ASSERT_TRUE(run_with_threads(scratch.file("wet.toml"), scratch.file("two"), 2));
  expect_same_results(scratch.file("one"), scratch.file("two"), 3);
}

TEST(WetRun, SurvivesTenKillsWithoutATrace) {
  kill_and_resume(10, 12, wet_scene() + "[run]\nseed = 3\ncheckpoint_every = 0.02\n", 3);
}

}  // namespace
}  // namespace floc::test
