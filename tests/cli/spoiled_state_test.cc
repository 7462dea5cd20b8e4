#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
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
  std::string arguments;
};

std::string without(std::string text, const std::string& line) {
  return text.replace(text.find(line), line.size(), "");
}

std::vector<Kind> kinds() {
  const std::string unloaded = small_scene().substr(0, small_scene().find("[[load]]"));
  const std::string settled = without(box_scene(2), "stop_time = 200\n");
  return {
      {"disks", small_scene(), "--until 2"},
      {"moving-disks", small_scene(), "--until 1 --set equilibrium.finish=dynamic"},
      {"sheared", unloaded + "[[load]]\ncontrol = \"simple_shear\"\nstrain = 0.02\nsteps = 2\n", ""},
      {"box", settled, ""},
      {"box-of-spheres", without(box_scene(3), "stop_time = 200\n"), "--until 0"},
      {"wet", wet_scene(), "--until 1"},
      {"hertz", scene_text("hertz") + "[[load]]\ncontrol = \"oedometric\"\nstrain = 0.01\nsteps = 1\n", ""},
      {"twisting",
       "[scene]\ndimension = 3\nunits = \"reduced\"\n[grains]\ncount = 30\ndiameter = {distribution = "
       "\"uniform\", min = "
       "0.8, max = 1.0}\n[contact]\nnormal = {law = \"linear\", stiffness = 1e3}\nadhesion = {law = \"tail\", "
       "force = "
       "1.0, range = 1e-2}\ndamping = {restitution = 0.1}\nfriction = {coefficient = 0.5, stiffness = "
       "1e3}\nrolling = "
       "{coefficient = 0.05, stiffness = 10.0}\ntwisting = {coefficient = 0.05, stiffness = 10.0}\n[cell]\n"
       "solid_fraction = 0.3\n[assembly]\nprotocol = \"direct\"\npressure = 0.1\n[[load]]\ncontrol = "
       "\"triaxial\"\n"
       "to = 0.15\nsteps = 1\n",
       ""},
  };
}

/// Changes datasets and attributes of states of every kind, one at a time. Each time, floc verify must report that the
/// file is not a valid state or not an equilibrium. Datasets and attributes that may have any value are listed in the
/// script and not changed.
TEST(SpoiledState, IsNoticedWhateverIsChanged) {
  const ScratchDirectory scratch;
  std::string states;
  for (const Kind& kind : kinds()) {
    write_text(scratch.file("scene.toml"), kind.scene);
    const Outcome made =
        run_floc("run scene.toml -o " + std::string(kind.name) + " " + kind.arguments, scratch.path());
    ASSERT_EQ(made.code, 0) << kind.name << made.err;
    const Outcome whole = run_floc("verify " + std::string(kind.name), scratch.path());
    EXPECT_EQ(whole.code, 0) << kind.name << whole.err;
    int last = 0;
    while (std::filesystem::exists(scratch.file(kind.name) + "/state-000" + std::to_string(last + 1) + ".h5"))
      ++last;
    states += " " + scratch.file(kind.name) + "/state-000" + std::to_string(last) + ".h5";
  }
  const std::string command = "/usr/bin/python3 '" + source_directory() + "/tests/cli/spoil_state.py' " +
                              floc_program() + " " + scratch.path() + states + " >" + scratch.file("out") +
                              " 2>" + scratch.file("err");
  EXPECT_EQ(std::system(command.c_str()), 0) << content_of(scratch.file("err"));
  std::cout << content_of(scratch.file("out"));
}

}  // namespace
}  // namespace floc::test
