#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "floc/io/state_file.h"
#include "support/small_run.h"
#include "support/two_runs.h"

/// Tests that a directory belongs to one run, and to one process at a time.
namespace floc::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

using RunDirectoryOf = SmallRun;

void copy_run(const std::string& from, const std::string& to) {
  fs::remove_all(to);
  fs::copy(from, to, fs::copy_options::recursive);
}

TEST(TwoRuns, OnOneDirectoryNeverMix) {
  start_two_runs_on_one_directory(6, 7);
}

TEST(TwoRuns, TheSecondIsToldWhoHoldsTheDirectory) {
  const ScratchDirectory scratch;
  write_text(scratch.file("small.toml"), small_scene());
  // This run has so many grains that it is still in progress when the other commands have been refused. It is killed at
  // the end of the test.
  const pid_t first = start_run(scratch.path(), "small.toml -o run --set grains.count=2000");
  while (!fs::exists(scratch.file("run/checkpoint"))) ::usleep(2000);
  char host[256] = {};
  ASSERT_EQ(::gethostname(host, sizeof host - 1), 0);
  const std::string holder = "process " + std::to_string(first) + " on " + host;
  for (const std::string mode : {"", " --resume", " --overwrite", " --seeds 1..2"}) {
    const Outcome o = run_floc("run small.toml -o run" + mode, scratch.path());
    EXPECT_EQ(o.code, 4) << mode;
    EXPECT_THAT(o.err, AllOf(HasSubstr("run: another run is writing into this directory (" + holder + ")")))
        << mode;
  }
  ::kill(first, SIGKILL);
  (void)wait_for(first);
  // the killed process has left its lock file behind, but the file no longer locks the directory
  EXPECT_TRUE(fs::exists(scratch.file("run/run.lock")));
  EXPECT_EQ(run_floc("run small.toml -o run --overwrite --until 0", scratch.path()).code, 0);
  EXPECT_FALSE(fs::exists(scratch.file("run/run.lock")));
}

TEST(RunDirectoryWithoutAName, IsRefused) {
  const ScratchDirectory scratch;
  write_text(scratch.file("small.toml"), small_scene());
  for (const std::string command : {"run small.toml -o ''", "draw '' -o a.svg", "moduli ''",
                                    "fit consolidation ''", "convert a.csv ''", "report a -o ''"}) {
    const Outcome o = run_floc(command, scratch.path());
    EXPECT_EQ(o.code, 2) << command;
    EXPECT_THAT(o.err, HasSubstr("the value is empty")) << command;
  }
  EXPECT_EQ(run_floc("run small.toml -o -", scratch.path()).code, 4);
  EXPECT_FALSE(fs::exists(scratch.file("-")));
}

TEST_F(RunDirectoryOf, OtherSeedsScenesAndMissingNumbersIsRefusedByFileName) {
  ASSERT_EQ(floc("run small.toml -o other --seed 4 --until 3").code, 0);
  ASSERT_EQ(floc("run small.toml -o scene --set grains.count=30 --until 3").code, 0);
  const auto expect_refused = [](const std::string& message) {
    for (const std::string command : {"fit consolidation mixed", "plot mixed -o a.svg",
                                      "report mixed -o a.html", "run small.toml -o mixed --resume"}) {
      const Outcome o = floc(command);
      EXPECT_EQ(o.code, 4) << command << o.err;
      EXPECT_THAT(o.err, HasSubstr(message)) << command;
    }
  };
  copy_run(file("run"), file("mixed"));
  fs::copy(file("other/state-0003.h5"), file("mixed/state-0003.h5"), fs::copy_options::overwrite_existing);
  expect_refused("mixed/state-0003.h5: this state was made with seed 4, but the states before it with seed 3");
  fs::copy(file("scene/state-0003.h5"), file("mixed/state-0003.h5"), fs::copy_options::overwrite_existing);
  expect_refused(
      "mixed/state-0003.h5: this state was made from a different scene than the states before it in the "
      "directory");
  fs::copy(file("run/state-0002.h5"), file("mixed/state-0003.h5"), fs::copy_options::overwrite_existing);
  expect_refused("mixed/state-0003.h5: this file contains state 2 of its run, but its name is that of state 3");
  fs::remove(file("mixed/state-0003.h5"));
  expect_refused("mixed/state-0003.h5: this state is missing, although state-0004.h5 exists");
}

TEST_F(RunDirectoryOf, AnEnsembleHasOneScene) {
  fs::remove_all(file("samples"));
  ASSERT_EQ(floc("run small.toml -o samples/seed-1 --seed 1 --until 2").code, 0);
  ASSERT_EQ(floc("run small.toml -o samples/seed-2 --seed 2 --until 2 --set grains.count=30").code, 0);
  const Outcome o = floc("fit consolidation samples");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("samples/seed-2/state-0000.h5: this state was made from a different scene than "
                               "the samples before it in the ensemble"));
}

TEST_F(RunDirectoryOf, ACutRowIsRefusedUntilResumeHasMendedIt) {
  const std::string whole = content_of(file("run/path.csv"));
  // Truncates the table at three places: in the middle of the last row, within the last cell of this row, and before
  // the final newline.
  for (const std::size_t cut : {std::size_t{90}, std::size_t{4}, std::size_t{1}}) {
    copy_run(file("run"), file("cut"));
    write_text(file("cut/path.csv"), whole.substr(0, whole.size() - cut));
    const Outcome refused = floc("fit elastic cut");
    EXPECT_EQ(refused.code, 4) << cut;
    EXPECT_THAT(refused.err, HasSubstr("cut/path.csv: the last row of this table is incomplete")) << cut;
    ASSERT_EQ(floc("run small.toml -o cut --resume").code, 0);
    EXPECT_EQ(rows_without_seconds(file("cut/path.csv")), rows_without_seconds(file("run/path.csv"))) << cut;
  }
}

}  // namespace
}  // namespace floc::test
