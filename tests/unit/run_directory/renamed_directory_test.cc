#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>

#include "floc/base/error.h"
#include "floc/run_directory/contact_tracker.h"
#include "floc/run_directory/drive.h"
#include "floc/scene/read_scene.h"
#include "support/kill_and_resume.h"
#include "support/scratch_directory.h"
#include "support/twenty_disks.h"

namespace floc {
namespace {

namespace fs = std::filesystem;
using test::ScratchDirectory;

/// Moment at which the directory is renamed.
enum class When { at_start, after_a_state, before_a_checkpoint, after_the_last_state };
/// New content at the old name of the directory.
enum class Then { nothing, an_empty_directory, a_run };

std::map<std::string, std::string> files_of(const std::string& directory) {
  std::map<std::string, std::string> files;
  if (!fs::exists(directory)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file()) files[entry.path()] = test::content_of(entry.path());
  return files;
}

/// Renames the directory of a run. Afterwards, its old path is what `then` says: free, an empty directory or another
/// run.
void take_away(const std::string& path, Then then) {
  fs::rename(path, path + "-renamed");
  if (then != Then::nothing) fs::create_directory(path);
  if (then != Then::a_run) return;
  std::ofstream(path + "/run.lock") << "process 1 on another host";
  std::ofstream(path + "/path.csv") << "its rows";
}

class RenamedDirectory : public ::testing::TestWithParam<bool> {};

/// The directory of a run is renamed. The run must stop when it would write its next file, and must not change files at
/// the old name.
TEST_P(RenamedDirectory, IsNoticedBeforeAnythingIsWritten) {
  const bool with_table = GetParam();
  int n = 0;
  for (const When when :
       {When::at_start, When::after_a_state, When::before_a_checkpoint, When::after_the_last_state})
    for (const Then then : {Then::nothing, Then::an_empty_directory, Then::a_run}) {
      const ScratchDirectory scratch;
      const std::string path = scratch.file("run");
      const Scene scene = test::twenty_disks();
      std::map<std::string, std::string> before;
      {
        RunDirectory directory(path, Existing::refuse, scene);
        floc::Run<2> run = start_or_resume<2>(directory, scene);
        std::unique_ptr<MotionTable<2>> table;
        if (with_table) table = track_contacts(run, scene, directory, 1.0);
        const auto move = [&] {
          if (before.empty() && !fs::exists(path + "-renamed")) take_away(path, then), before = files_of(path);
        };
        DriveOptions<2> driving;
        driving.until = when == When::after_the_last_state ? 0 : 2;
        if (when == When::before_a_checkpoint) driving.checkpoint_every = 0.0;
        if (when == When::at_start || when == When::before_a_checkpoint)
          driving.chunk = [&](const auto&) { move(); };
        else
          driving.equilibrium = [&](const auto&...) { move(); };
        EXPECT_THROW((void)drive(run, directory, driving, table.get()), IoError) << int(when) << int(then);
      }
      EXPECT_EQ(files_of(path), before) << int(when) << int(then);
      EXPECT_EQ(fs::exists(path), then != Then::nothing);
      // Under its new name, the directory still contains a run that can be resumed.
      RunDirectory renamed(path + "-renamed", Existing::resume, scene);
      floc::Run<2> resumed = start_or_resume<2>(renamed, scene);
      DriveOptions<2> first;
      first.until = 0;
      EXPECT_EQ(drive(resumed, renamed, first).outcome, DriveReport::done);
      ++n;
    }
  std::cout << n << " ways to take the directory of a run away\n";
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutATable, RenamedDirectory, ::testing::Bool());

/// If the lock file was deleted, the process still owns the directory. If another lock file has replaced it,
/// the directory belongs to another process.
TEST(RenamedDirectory, LocksAreToldApart) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("run");
  const ClaimedDirectory claim(path, Existing::refuse, "run");
  EXPECT_NO_THROW(claim.require_held());
  fs::remove(path + "/run.lock");
  EXPECT_NO_THROW(claim.require_held());
  std::ofstream(path + "/run.lock") << "another";
  EXPECT_THROW(claim.require_held(), IoError);
}

}  // namespace
}  // namespace floc
