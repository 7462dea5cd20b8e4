#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "support/box_scene.h"
#include "support/kill_and_resume.h"
#include "support/scene_text.h"
#include "support/wet_scene.h"

namespace floc::test {
namespace {

struct Kind {
  const char* name;
  std::string scene;
  std::string arguments = "";
  bool is_fitted = false;  ///< whether the path is long enough for a fit
};

/// Scene of spheres under Hertz's law without adhesion and without liquid.
std::string spheres(const std::string& stages) {
  return scene_text("hertz") + stages;
}

std::string stage(const std::string& keys) {
  return "[[load]]\n" + keys + "\n";
}

std::vector<Kind> kinds() {
  return {
      {"a path of cohesive disks", small_scene(), "--set load.0.to=30", true},
      {"its first state", small_scene(), "--until 0"},
      {"an ensemble", small_scene(), "--seeds 1..2 --until 2"},
      {"a box that settles", box_scene(2), ""},
      {"a box that is stopped", box_scene(3), "--set equilibrium.stop_time=2"},
      {"wet spheres", wet_scene()},
      {"one state of spheres", spheres("")},
      {"an oedometer", spheres(stage("control = \"oedometric\"\nstrain = 0.01\nsteps = 2"))},
      {"a triaxial test", spheres(stage("control = \"triaxial\"\nstrain = 0.01\nsteps = 2"))},
      {"a constant volume", spheres(stage("control = \"constant_volume\"\nstrain = 0.01\nsteps = 2"))},
      {"a simple shear", spheres(stage("control = \"simple_shear\"\nstrain = 0.01\nsteps = 2"))},
  };
}

/// Returns the commands that are listed below "You may run next:".
std::vector<std::string> commands_in(const std::string& text) {
  std::vector<std::string> commands;
  std::istringstream in(text.substr(std::min(text.find("You may run next:"), text.size())));
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("  floc ")) commands.push_back(line.substr(7));
  return commands;
}

TEST(NextSteps, AreCommandsThatWorkForWhatWasRun) {
  const ScratchDirectory scratch;
  int n_commands = 0;
  for (const Kind& kind : kinds()) {
    write_text(scratch.file("scene.toml"), kind.scene);
    const Outcome made = run_floc("run scene.toml --overwrite -o 'a run' " + kind.arguments, scratch.path());
    ASSERT_EQ(made.code, 0) << kind.name << made.err;
    const std::vector<std::string> commands = commands_in(made.err);
    EXPECT_GE(commands.size(), 1u) << kind.name << made.err;
    for (const std::string& command : commands) {
      const Outcome next = run_floc(command, scratch.path());
      EXPECT_EQ(next.code, 0) << kind.name << ": floc " << command << "\n" << next.err;
      ++n_commands;
    }
    EXPECT_EQ(made.err.find("floc fit consolidation") != std::string::npos, kind.is_fitted) << kind.name;
    std::filesystem::remove_all(scratch.file("a run"));
  }
  std::cout << n_commands << " commands after " << kinds().size() << " kinds of runs\n";
}

}  // namespace
}  // namespace floc::test
