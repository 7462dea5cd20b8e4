#pragma once

#include <limits>
#include <string>

#include "floc/run_directory/drive.h"
#include "floc/scene/read_scene.h"
#include "support/kill_and_resume.h"

namespace floc::test {

/// Runs a scene in a new directory like `floc run --no-timing`, but always with the given number of threads. The
/// program itself would use fewer threads for a sample with too few grains (useful_threads()).
/// @return whether every equilibrium up to `until` is saved
template <int Dim>
bool run_with_threads(Scene scene, const std::string& directory, int threads, int until) {
  scene.relaxation.threads = threads;
  RunDirectory run_directory(directory, Existing::refuse, scene);
  Run<Dim> run = start_or_resume<Dim>(run_directory, scene);
  DriveOptions<Dim> options;
  options.until = until;
  options.timing = false;
  return drive(run, run_directory, options).outcome == DriveReport::done;
}

inline bool run_with_threads(const std::string& scene_file, const std::string& directory, int threads,
                             int until = std::numeric_limits<int>::max()) {
  const Scene scene = read_scene(scene_file);
  return scene.dimension == 3 ? run_with_threads<3>(scene, directory, threads, until)
                              : run_with_threads<2>(scene, directory, threads, until);
}

/// Runs a scene of nine equilibria, like small_scene(), with one thread and with three, and expects equal results.
inline void expect_no_trace_of_threads(const std::string& scene) {
  const ScratchDirectory scratch;
  write_text(scratch.file("scene.toml"), scene);
  ASSERT_TRUE(run_with_threads(scratch.file("scene.toml"), scratch.file("one"), 1));
  ASSERT_TRUE(run_with_threads(scratch.file("scene.toml"), scratch.file("three"), 3));
  expect_same_results(scratch.file("one"), scratch.file("three"));
}

}  // namespace floc::test
