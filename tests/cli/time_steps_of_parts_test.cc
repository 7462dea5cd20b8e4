#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "floc/io/csv.h"
#include "support/kill_and_resume.h"
#include "support/places.h"
#include "support/scene_text.h"
#include "support/threaded_run.h"

namespace floc::test {
namespace {

/// Scene whose grains are put together without friction, in steps longer than those of its load path.
std::string scene_of_long_steps() {
  const std::string smooth = exchanged(small_scene(), "rolling = {coefficient = 0.005, stiffness = 1.0}\n", "");
  return exchanged(smooth, "[assembly]\n", "[assembly]\nfriction = 0\ntime_step = 0.54\n");
}

TEST(TimeStepsOfParts, SurviveKillsWithoutATrace) {
  kill_and_resume(10, 41, scene_of_long_steps());
}

TEST(TimeStepsOfParts, ThreadsLeaveNoTrace) {
  expect_no_trace_of_threads(scene_of_long_steps());
}

/// Shipped scene, with changes after which a run takes about a second, and a time step of its assembly that its damping
/// allows.
struct LongSteps {
  const char* scene;
  std::string changes;
  const char* time_step;
};

void PrintTo(const LongSteps& steps, std::ostream* out) {
  *out << steps.scene;
}

class LongStepsOfAKind : public testing::TestWithParam<LongSteps> {
 protected:
  /// Runs the scene with a time step of its assembly and returns the number of time steps to the last state.
  double steps_of(const std::string& time_step, const ScratchDirectory& scratch) {
    const std::string run = "run" + time_step;
    const Outcome made = run_floc(
        "run " + source_directory() + "/data/scenes/" + GetParam().scene +
            ".toml --set grains.count=100 --set assembly.friction=0 --until 0 --set assembly.time_step=" +
            time_step + " " + GetParam().changes + " -o " + run,
        scratch.path());
    EXPECT_EQ(made.code, 0) << made.err;
    const Outcome verified = run_floc("verify " + run, scratch.path());
    EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
    const CsvTable path = CsvTable::read(scratch.file(run + "/path.csv"));
    return path.number(0, path.column("n_steps"));
  }
};

TEST_P(LongStepsOfAKind, LeadToEquilibriaInFewerSteps) {
  const ScratchDirectory scratch;
  EXPECT_LT(steps_of(GetParam().time_step, scratch), steps_of("0.2", scratch));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, LongStepsOfAKind,
    testing::Values(LongSteps{"biaxial_dense", "", "0.54"}, LongSteps{"wet_demo", "", "0.72"},
                    LongSteps{"spheres_demo", "", "0.54"},
                    LongSteps{"spheres_demo", "--set contact.damping.critical_fraction=0.3", "0.72"},
                    LongSteps{"spheres_demo",
                              "--set equilibrium.softening=30 --set contact.damping.critical_fraction=0.3",
                              "0.72"}),
    [](const auto& steps) { return std::string(steps.param.scene) + std::to_string(steps.index); });

TEST(TimeStepsOfParts, ThatDivergeAreNamed) {
  const ScratchDirectory scratch;
  const Outcome made =
      run_floc("run " + source_directory() +
                   "/data/scenes/spheres_demo.toml --until 0 --set assembly.time_step=0.79 -o run",
               scratch.path());
  EXPECT_EQ(made.code, 3) << made.err;
  EXPECT_NE(made.err.find("the motion diverged because the time step"), std::string::npos) << made.err;
}

}  // namespace
}  // namespace floc::test
