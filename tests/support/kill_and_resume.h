#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "floc/base/random.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scene_text.h"

namespace floc::test {

/// Returns a scene of type 2 with a few dozen grains. A run of the scene has an assembly and nine equilibria, and takes
/// about a second.
inline std::string small_scene() {
  return scene_text("small") + R"([[load]]
name = "load"
to = 1.0
steps_per_decade = 3
[[load]]
name = "unload"
to = 0.1
steps_per_decade = 1
[run]
seed = 3
checkpoint_every = 0.02
)";
}

/// Starts floc run in the background.
/// @return its process id
inline pid_t start_run(const std::string& directory, const std::string& arguments) {
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string command = "exec " + floc_program() + " run " + arguments + " 2>/dev/null >/dev/null";
    if (::chdir(directory.c_str()) == 0) ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  return child;
}

/// Waits for a process.
/// @return its exit status, as waitpid() gives it
inline int wait_for(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

/// Returns path.csv without the column of wall times, the only column that differs from run to run.
inline std::string rows_without_seconds(const std::string& file) {
  std::istringstream in(content_of(file));
  std::string line, kept;
  std::size_t seconds = std::string::npos;  // index of the column
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string field;
    for (std::size_t place = 0; std::getline(fields, field, ','); ++place) {
      if (field == "seconds") seconds = place;
      if (place != seconds) kept += field + ",";
    }
    kept += "\n";
  }
  return kept;
}

/// Expects that two runs have identical results: the state files byte for byte, and the rows of path.csv except for the
/// wall times.
/// @param n_states  expected number of states; the default is the number of the small scene
inline void expect_same_results(const std::string& a, const std::string& b, int n_states = 9) {
  int n = 0;
  for (const auto& entry : std::filesystem::directory_iterator(a)) {
    const std::string name = entry.path().filename();
    if (entry.path().extension() != ".h5") continue;
    ++n;
    EXPECT_TRUE(content_of(a + "/" + name) == content_of(b + "/" + name)) << name;
  }
  EXPECT_EQ(n, n_states);
  EXPECT_EQ(rows_without_seconds(a + "/path.csv"), rows_without_seconds(b + "/path.csv"));
}

/// Kills a run with SIGKILL at random times, and resumes it after each kill. If the run ends before all kills have been
/// made, a new run is started. Expects that the final results equal the results of a run without interruptions.
/// @param n_states  number of states of the scene
inline void kill_and_resume(int n_kills, std::uint64_t seed, const std::string& scene = small_scene(),
                            int n_states = 9) {
  const ScratchDirectory scratch;
  write_text(scratch.file("small.toml"), scene);
  ASSERT_EQ(run_floc("run small.toml -o whole", scratch.path()).code, 0);
  RandomStream random(seed, 1);
  for (int kills = 0; kills < n_kills;) {
    const pid_t child = start_run(scratch.path(), "small.toml -o broken --resume");
    ::usleep(static_cast<useconds_t>(1000.0 * random.uniform(1.0, 300.0)));
    ::kill(child, SIGKILL);
    const int status = wait_for(child);
    kills += WIFSIGNALED(status);
    if (WIFSIGNALED(status)) continue;
    ASSERT_EQ(WEXITSTATUS(status), 0);
    expect_same_results(scratch.file("whole"), scratch.file("broken"), n_states);
    std::filesystem::remove_all(scratch.file("broken"));
  }
  ASSERT_EQ(run_floc("run small.toml -o broken --resume", scratch.path()).code, 0);
  expect_same_results(scratch.file("whole"), scratch.file("broken"), n_states);
}

}  // namespace floc::test
