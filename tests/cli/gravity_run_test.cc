#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "floc/io/csv.h"
#include "support/kill_and_resume.h"
#include "support/scene_text.h"
#include "support/threaded_run.h"

namespace floc::test {
namespace {

/// Scene of grains that fall onto a floor; the run takes about a second.
std::string bed_scene(int dimension, const std::string& vertical = "floor") {
  const bool plane = dimension == 2;
  std::string text =
      std::string("[scene]\nname = \"bed\"\nunits = \"reduced\"\ndimension = ") + (plane ? "2" : "3") +
      "\n[grains]\ncount = 60\ndiameter = {distribution = \"uniform\", min = 0.8, max = 1.0}\n"
      "[contact]\nnormal = {law = \"linear\", stiffness = 1e4}\ndamping = {restitution = 0.3}\n"
      "friction = {coefficient = 0.3, stiffness = 1e4}\n[assembly]\nprotocol = \"direct\"\n[box]\n";
  text +=
      plane ? "sides = [7, 20]\nboundary = {x = \"periodic\", y = \"" + vertical + "\"}\ngravity = [0, -0.5]\n"
            : "sides = [4, 4, 12]\nboundary = {x = \"periodic\", y = \"fixed\", z = \"" + vertical +
                  "\"}\ngravity = [0, 0, -0.5]\n";
  text += "friction = 0.3\nadhesion = 0\n";
  if (vertical == "lid") text += "pressure = 2\nmass = 20\n[[load]]\nto = 4\nsteps = 1\n";
  return text + "[run]\nseed = 3\ncheckpoint_every = 0.02\n";
}

class GravityRun : public ::testing::TestWithParam<int> {
 protected:
  Outcome run(const std::string& scene, const std::string& arguments) {
    write_text(scratch_.file("bed.toml"), scene);
    return run_floc("run bed.toml " + arguments, scratch_.path());
  }
  Outcome floc(const std::string& arguments) { return run_floc(arguments, scratch_.path()); }
  std::string file(const std::string& name) const { return scratch_.file(name); }

  ScratchDirectory scratch_;
};

TEST_P(GravityRun, MakesBedsThatVerifyAndHaveModuli) {
  for (const char* vertical : {"floor", "lid"}) {
    const std::string out = std::string("out-") + vertical;
    const Outcome made = run(bed_scene(GetParam(), vertical), "-o " + out);
    ASSERT_EQ(made.code, 0) << made.err;
    const Outcome verified = floc("verify " + out + "/state-0000.h5");
    EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
    for (const char* command : {"info", "network", "moduli", "structure --profile profile.csv"})
      EXPECT_EQ(floc(std::string(command) + " " + out + "/state-0000.h5").code, 0) << command;
  }
  EXPECT_EQ(floc("verify out-lid/state-0001.h5").code, 0);
}

TEST_P(GravityRun, GivesTheSameFilesForTwoThreads) {
  ASSERT_EQ(run(bed_scene(GetParam()), "-o one").code, 0);
  ASSERT_TRUE(run_with_threads(file("bed.toml"), file("two"), 2, 0));
  expect_same_results(file("one"), file("two"), 1);
}

TEST_P(GravityRun, SurvivesKillsWithoutATrace) {
  kill_and_resume(4, 11, bed_scene(GetParam()), 1);
}

TEST_P(GravityRun, StartsFromABed) {
  ASSERT_EQ(run(bed_scene(GetParam()), "-o first").code, 0);
  std::string next = exchanged(bed_scene(GetParam()), "protocol = \"direct\"",
                               "protocol = \"state\"\nstate = \"first/state-0000.h5\"");
  const std::size_t grains = next.find("[grains]"), contact = next.find("[contact]");
  next.erase(grains, contact - grains);
  next = exchanged(next, GetParam() == 2 ? "sides = [7, 20]\n" : "sides = [4, 4, 12]\n", "");
  const Outcome made = run(next, "-o again");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(floc("verify again/state-0000.h5").code, 0);
}

TEST_P(GravityRun, NamesWrongKeys) {
  const std::string scene = bed_scene(GetParam()), g = GetParam() == 2 ? "[0, -0.5]" : "[0, 0, -0.5]";
  const auto refusal = [&](const std::string& from, const std::string& to, const std::string& words) {
    const Outcome made = run(exchanged(scene, from, to), "-o wrong");
    EXPECT_NE(made.code, 0) << to;
    EXPECT_THAT(made.err, testing::HasSubstr(words)) << to;
  };
  refusal("gravity = " + g, "gravity = [1]", "box.gravity has 1 numbers: expected");
  refusal("gravity = " + g, "gravity = " + std::string(GetParam() == 2 ? "[0, 0.5]" : "[0, 0, 0.5]"),
          "expected a negative number for this axis");
  refusal("gravity = " + g, "gravity = " + std::string(GetParam() == 2 ? "[1, -0.5]" : "[1, 0, -0.5]"),
          "gravity acts along axis 1, whose boundary is \"periodic\"");
  refusal("gravity = " + g + "\n", "", "expected a negative number for this axis");
  refusal("gravity = " + g, "gravity = " + g + "\npressure = 1", "box.pressure is not allowed here");
  refusal("gravity = " + g, "gravity = " + g + "\nspeed = 1", "box.speed is not allowed here");
  refusal("[run]", "[[load]]\nto = 4\nsteps = 1\n[run]", "no wall of the box moves");
  refusal("\"floor\"", "\"flor\"", "\"floor\"");
}

INSTANTIATE_TEST_SUITE_P(Dimensions, GravityRun, ::testing::Values(2, 3));

}  // namespace
}  // namespace floc::test
