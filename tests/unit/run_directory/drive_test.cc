#include "floc/run_directory/drive.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "floc/scene/read_scene.h"
#include "floc/verification/verification.h"
#include "support/kill_and_resume.h"
#include "support/scratch_directory.h"
#include "support/twenty_disks.h"

namespace floc {
namespace {

using test::ScratchDirectory;

/// Number of equilibria of twenty_disks().
constexpr int kEquilibria = 5;

/// Continues the run in a directory until the options stop it or until it is complete.
DriveReport drive_in(const std::string& path, const DriveOptions<2>& driving) {
  const Scene scene = test::twenty_disks();
  RunDirectory directory(path, Existing::resume, scene);
  floc::Run<2> run = start_or_resume<2>(directory, scene);
  return drive(run, directory, driving);
}

TEST(Drive, ARunStoppedAtAnyStretchAndResumedIsTheUnbrokenRun) {
  const ScratchDirectory scratch;
  EXPECT_EQ(drive_in(scratch.file("whole"), {}).outcome, DriveReport::done);
  DriveOptions<2> driving;
  int n_chunks = 0, n_stops = 0;
  driving.stop = [&] { return ++n_chunks % 37 == 0; };
  while (drive_in(scratch.file("broken"), driving).outcome == DriveReport::stopped) ++n_stops;
  EXPECT_GT(n_stops, 3);
  test::expect_same_results(scratch.file("whole"), scratch.file("broken"), kEquilibria);
  EXPECT_FALSE(std::filesystem::exists(scratch.file("broken") + "/checkpoint/checkpoint.h5"));
}

TEST(Drive, TellsOfEachStretchAndOfEachEquilibriumOnceItIsSaved) {
  const ScratchDirectory scratch;
  DriveOptions<2> driving;
  int n_chunks = 0;
  std::vector<int> steps;
  driving.chunk = [&](const floc::Run<2>& run) { n_chunks += !run.finished(); };
  driving.equilibrium = [&](const State<2>& state, const RelaxationReport& report, double seconds) {
    EXPECT_TRUE(std::filesystem::exists(state_file(scratch.file("run"), state.path.step)));
    EXPECT_EQ(report.ending, state.path.ending);
    EXPECT_GE(seconds, 0.0);
    steps.push_back(state.path.step);
  };
  driving.until = 1;
  EXPECT_EQ(drive_in(scratch.file("run"), driving).outcome, DriveReport::done);
  EXPECT_EQ(steps, (std::vector<int>{0, 1}));
  EXPECT_GT(n_chunks, 0);
}

TEST(Drive, SaysWhatBlocksAStepThatGivesUp) {
  const ScratchDirectory scratch;
  Scene scene = test::twenty_disks();
  scene.relaxation.tolerance.force = 1e-300;  // a tolerance that no forces can meet
  scene.relaxation.max_time = 500.0;
  RunDirectory directory(scratch.file("run"), Existing::refuse, scene);
  floc::Run<2> run = start_or_resume<2>(directory, scene);
  const DriveReport report = drive(run, directory, {});
  EXPECT_EQ(report.outcome, DriveReport::gave_up);
  EXPECT_EQ(report.relaxation.blocking.substr(0, 5), "force");
  EXPECT_TRUE(std::filesystem::exists(scratch.file("run") + "/checkpoint/checkpoint.h5"));
}

TEST(Drive, LeavesStatesThatVerificationPasses) {
  const ScratchDirectory scratch;
  EXPECT_EQ(drive_in(scratch.file("run"), {}).outcome, DriveReport::done);
  for (int step = 0; step < kEquilibria; ++step) {
    const AnyState state = read_state(state_file(scratch.file("run"), step));
    for (const Criterion& c : verify_equilibrium(std::get<State<2>>(state)))
      EXPECT_TRUE(c.holds) << step << " " << c.name << " " << c.where;
  }
}

}  // namespace
}  // namespace floc
