#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using testing::HasSubstr;

/// Fixture: runs of sixty disks; each test chooses the length of the last stage.
class LongerPath : public testing::Test {
 protected:
  Outcome run(const std::string& directory, const std::string& changes, const std::string& options = "") const {
    return run_floc(fmt::format("run {}/data/scenes/biaxial_dense.toml -o {} --no-timing --set grains.count=60 "
                                "--set load.0.strain_step=0.004 {} {}",
                                source_directory(), directory, changes, options),
                    scratch_.path());
  }
  std::string rows(const std::string& directory) const {
    return content_of(scratch_.file(directory + "/path.csv"));
  }

  ScratchDirectory scratch_;
};

TEST_F(LongerPath, ResumedIsTheRunThatHadItFromTheBeginning) {
  ASSERT_EQ(run("a", "--set load.0.strain=0.008").code, 0);
  const Outcome longer = run("a", "--set load.0.strain=0.016", "--resume");
  ASSERT_EQ(longer.code, 0) << longer.err;
  ASSERT_EQ(run("whole", "--set load.0.strain=0.016").code, 0);
  EXPECT_EQ(rows("a"), rows("whole"));
  // Other commands treat the directory like the directory of a single run.
  EXPECT_EQ(run_floc("verify a", scratch_.path()).code, 0);
  EXPECT_EQ(run_floc("fit strength a", scratch_.path()).code, 0);
  // The first command extends the stage once more. The second command is identical to the first, so it finds a complete
  // run.
  EXPECT_EQ(run("a", "--set load.0.strain=0.02", "--resume").code, 0);
  EXPECT_EQ(run("a", "--set load.0.strain=0.02", "--resume").code, 0);
}

TEST_F(LongerPath, WhoseStepsDifferIsRefusedAndNothingIsLost) {
  ASSERT_EQ(run("a", "--set load.0.strain=0.008").code, 0);
  const std::string before = rows("a");
  const std::pair<const char*, const char*> changes[] = {
      {"--set load.0.strain=0.01", "a/state-0001.h5: step 1 of the load path in the scene differs"},
      {"--set load.0.strain=0.004", "a/state-0002.h5: step 2 of the load path in the scene differs"},
      {"--set load.0.strain=0.016 --set grains.density=2", "grains.density = 2 here"},
      {"--set load.0.strain=0.016 --set run.seed=2", "made with another scene or seed"},
      {"--set load.0.strain=0.008 --set load.0.name=other", "load.0.name = "},
  };
  for (const auto& [change, words] : changes) {
    const Outcome o = run("a", change, "--resume");
    EXPECT_EQ(o.code, 4) << change;
    EXPECT_THAT(o.err, HasSubstr(words)) << change;
  }
  EXPECT_EQ(rows("a"), before);
}

TEST_F(LongerPath, MayHaveAStageMore) {
  const std::string scene = content_of(source_directory() + "/data/scenes/biaxial_dense.toml");
  const auto write = [&](const std::string& stages) {
    std::string text = scene.substr(0, scene.find("[[load]]")) + stages;
    text.replace(text.find("count = 1400"), 12, "count = 60");
    write_text(scratch_.file("s.toml"), text);
  };
  const std::string up = "[[load]]\nto = 2e-3\nsteps = 1\n";
  write(up);
  ASSERT_EQ(run_floc("run s.toml -o b --no-timing", scratch_.path()).code, 0);
  write(up + "[[load]]\nto = 1e-3\nsteps = 1\n");
  const Outcome o = run_floc("run s.toml -o b --no-timing --resume", scratch_.path());
  ASSERT_EQ(o.code, 0) << o.err;
  ASSERT_EQ(run_floc("run s.toml -o c --no-timing", scratch_.path()).code, 0);
  EXPECT_EQ(rows("b"), rows("c"));
}

}  // namespace
}  // namespace floc::test
