#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "support/kill_and_resume.h"

namespace floc::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// Fixture: a scratch directory that contains the small scene.
class RunSeeds : public testing::Test {
 protected:
  void SetUp() override { write_text(scratch_.file("small.toml"), small_scene()); }
  Outcome run(const std::string& arguments) const {
    return run_floc("run small.toml --set grains.count=12 " + arguments, scratch_.path());
  }
  std::string file(const std::string& name) const { return scratch_.file(name); }

  ScratchDirectory scratch_;
};

TEST_F(RunSeeds, MakesTheSampleThatEachSeedMakesAlone) {
  const Outcome all = run("-o all --seeds 3..5 --jobs 2 --until 0");
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_THAT(all.err, AllOf(HasSubstr("seed 4: done"), HasSubstr("floc moduli all/seed-*/state-*.h5")));
  ASSERT_EQ(run("-o alone --seed 4 --until 0").code, 0);
  EXPECT_TRUE(content_of(file("all/seed-4/state-0000.h5")) == content_of(file("alone/state-0000.h5")));
  EXPECT_FALSE(content_of(file("all/seed-3/state-0000.h5")) == content_of(file("all/seed-5/state-0000.h5")));
  EXPECT_FALSE(fs::exists(file("all/seed-2")));
  EXPECT_THAT(content_of(file("all/seed-5.log")), HasSubstr("step 1/"));

  EXPECT_EQ(run("-o all --seeds 3..5 --until 0").code, 4);
  EXPECT_EQ(run("-o all --seeds 2..5 --until 0 --resume").code, 0);
  EXPECT_TRUE(fs::exists(file("all/seed-2/state-0000.h5")));
}

TEST_F(RunSeeds, ExitsWithTheWorstOfItsSamplesAndNamesIt) {
  // A file occupies the name of the directory of seed 2, so that this sample fails.
  fs::create_directories(file("some"));
  write_text(file("some/seed-2"), "in the way");
  const Outcome some = run("-o some --seeds 1..2 --until 0 --resume");
  EXPECT_EQ(some.code, 4);
  EXPECT_THAT(some.err,
              AllOf(HasSubstr("seed 1: done"),
                    HasSubstr("seed 2: failed with exit code 4; its messages are in some/seed-2.log")));
  EXPECT_THAT(content_of(file("some/seed-2.log")),
              HasSubstr("some/seed-2: this is a file: expected a directory"));
}

TEST_F(RunSeeds, StoppedBySignalsCheckpointsEverySample) {
  const pid_t child = start_run(scratch_.path(),
                                "small.toml -o stopped --seeds 1..3 --jobs 2 "
                                "--set grains.count=400 --set run.checkpoint_every=1e6");
  while (!fs::exists(file("stopped/seed-2/checkpoint"))) ::usleep(10000);
  ::usleep(300000);
  ::kill(child, SIGTERM);
  const int status = wait_for(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  for (const char* seed : {"1", "2"})
    EXPECT_TRUE(fs::exists(file(std::string("stopped/seed-") + seed + "/checkpoint/checkpoint.h5"))) << seed;
  EXPECT_FALSE(fs::exists(file("stopped/seed-3")));
}

TEST_F(RunSeeds, SaysWhatIsWrongBeforeAnySampleStarts) {
  for (const char* seeds : {"3", "5..3", "a..b", "1...3", "-1..3"}) {
    const Outcome bad = run(std::string("-o bad --seeds=") + seeds);
    EXPECT_EQ(bad.code, 4) << seeds;
    EXPECT_THAT(bad.err, HasSubstr("expected A..B")) << seeds;
  }
  EXPECT_EQ(run("-o bad --seeds 1..2 --set cell.mass=-1").code, 4);
  EXPECT_EQ(run("-o bad --seeds 1..2 --seed 3").code, 2);
  EXPECT_EQ(run("-o bad --jobs 2").code, 2);
  EXPECT_FALSE(fs::exists(file("bad")));
  EXPECT_EQ(run("-o small.toml/below --seeds 1..2").code, 1);
}

}  // namespace
}  // namespace floc::test
