#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "floc/base/random.h"
#include "floc/io/state_file.h"
#include "floc/run_directory/one_run.h"
#include "support/kill_and_resume.h"

namespace floc::test {

/// Starts two runs with different seeds in one directory, with and without --resume and --overwrite. The second run
/// starts after a random delay. In every case, the directory must contain all results of one run and none of the other
/// run.
inline void start_two_runs_on_one_directory(int n_times, std::uint64_t seed) {
  const ScratchDirectory scratch;
  write_text(scratch.file("small.toml"), small_scene());
  const std::string scene = "small.toml --set grains.count=20 --set load.0.steps_per_decade=1 --seed ";
  constexpr int kStates = 5;
  for (const std::string own : {"1", "2"})
    ASSERT_EQ(run_floc("run " + scene + own + " -o whole-" + own, scratch.path()).code, 0);
  RandomStream random(seed, 1);
  const std::vector<std::string> modes = {"", " --resume", " --overwrite"};
  for (int k = 0; k < n_times; ++k) {
    const auto mode = [&] { return modes[static_cast<std::size_t>(random.uniform(0.0, 2.999))]; };
    const pid_t first = start_run(scratch.path(), scene + "1 -o both" + mode());
    ::usleep(static_cast<useconds_t>(1000.0 * random.uniform(0.0, 400.0)));
    const pid_t second = start_run(scratch.path(), scene + "2 -o both" + mode());
    const int first_code = WEXITSTATUS(wait_for(first)), second_code = WEXITSTATUS(wait_for(second));
    EXPECT_TRUE(first_code == 0 || second_code == 0) << first_code << " " << second_code;
    for (const int code : {first_code, second_code}) EXPECT_TRUE(code == 0 || code == 4) << code;
    EXPECT_NO_THROW(require_one_run(scratch.file("both")));
    const auto made = std::get<State<2>>(read_state(state_file(scratch.file("both"), 0))).provenance.seed;
    expect_same_results(scratch.file("whole-" + std::to_string(made)), scratch.file("both"), kStates);
    EXPECT_FALSE(std::filesystem::exists(scratch.file("both/run.lock")));
    std::filesystem::remove_all(scratch.file("both"));
  }
}

}  // namespace floc::test
