#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "floc/io/state_file.h"
#include "floc/neighbors/find_contacts.h"
#include "support/contact_laws.h"
#include "support/kill_and_resume.h"
#include "support/scene_text.h"
#include "support/threaded_run.h"

namespace floc::test {
namespace {

/// Scene of glass beads, assembled without friction, then loaded and unloaded: four equilibria in a few
/// seconds.
std::string beads() {
  return scene_text("beads") + R"([[load]]
name = "load"
to = 10e6
steps_per_decade = 2
[[load]]
name = "unload"
to = 1e6
steps_per_decade = 1
inertial_number_cap = 1e-2
[equilibrium]
force = 1e-4
moment = 1e-4
stress = 1e-4
energy = 1e-7
[run]
seed = 3
checkpoint_every = 0.02
)";
}

class SpheresRun : public ::testing::Test {
 protected:
  Outcome run(const std::string& scene, const std::string& arguments) {
    write_text(scratch_.file("beads.toml"), scene);
    return run_floc("run beads.toml " + arguments, scratch_.path());
  }
  std::string file(const std::string& name) const { return scratch_.file(name); }

  ScratchDirectory scratch_;
};

TEST_F(SpheresRun, MakesStatesThatVerifyAndRowsWithThreeSides) {
  const Outcome made = run(beads(), "-o out");
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome verified = run_floc("verify out/state-*.h5", scratch_.path());
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  EXPECT_THAT(content_of(file("out/path.csv")),
              testing::HasSubstr(",state,ending,L3,stress_1,stress_2,stress_3,strain_1,"));
  const Outcome moduli = run_floc("moduli out/state-0003.h5", scratch_.path());
  EXPECT_EQ(moduli.code, 0) << moduli.err;
}

TEST_F(SpheresRun, GivesTheSameFilesForTwoThreads) {
  ASSERT_EQ(run(beads(), "--until 1 -o one").code, 0);
  ASSERT_TRUE(run_with_threads(file("beads.toml"), file("two"), 2, 1));
  expect_same_results(file("one"), file("two"), 2);
}

TEST_F(SpheresRun, SurvivesTenKillsWithoutATrace) {
  kill_and_resume(10, 7, beads(), 4);
}

/// The beads are assembled without friction, shaken, then compressed with full friction.
TEST_F(SpheresRun, ShakesWhatItHasPutTogetherAndSurvivesKills) {
  const std::string shaken =
      exchanged(beads(), "friction = 0.02", "friction = 0\nvibration = {dilation = 1.02, collisions = 20}");
  const Outcome made = run(shaken, "--until 1 -o out");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(run_floc("verify out/state-*.h5", scratch_.path()).code, 0);
  kill_and_resume(5, 8, shaken, 5);
}

/// A run that starts from the first equilibrium and shakes the beads ends in another packing of them, which depends on
/// the seed.
TEST_F(SpheresRun, StartsFromAShakenState) {
  ASSERT_EQ(run(beads(), "--until 0 -o first").code, 0);
  std::string shaken = exchanged(beads(), "protocol = \"direct\"",
                                 "protocol = \"state\"\nstate = \"first/state-0000.h5\"\n"
                                 "vibration = {dilation = 1.02, collisions = 20}");
  const std::size_t grains = shaken.find("[grains]"), contact = shaken.find("[contact]");
  shaken.erase(grains, contact - grains);
  shaken = exchanged(shaken, "solid_fraction = 0.45\n", "");
  write_text(file("shaken.toml"), shaken);
  const auto made = [&](const char* seed, const char* out) {
    return run_floc(std::string("run shaken.toml --until 0 --seed ") + seed + " -o " + out, scratch_.path());
  };
  const Outcome one = made("1", "c1");
  ASSERT_EQ(one.code, 0) << one.err;
  ASSERT_EQ(made("1", "again").code, 0);
  ASSERT_EQ(made("2", "c2").code, 0);
  EXPECT_EQ(rows_without_seconds(file("c1/path.csv")), rows_without_seconds(file("again/path.csv")));
  EXPECT_NE(rows_without_seconds(file("c1/path.csv")), rows_without_seconds(file("c2/path.csv")));
}

TEST(SpheresState, IsReadWithAWarningOfDeepOverlapsAndRefusedWhereTheirMeanIsDeep) {
  const ScratchDirectory scratch;
  State<3> state;
  state.packing.law += test::hertz(70.0, 0.3);
  state.packing.cell.matrix *= 5.0;
  state.packing.grains = Grains<3>::with_size(3);
  state.packing.grains.radius.assign(3, 0.5);
  state.packing.grains.mass.assign(3, 1.0);
  state.packing.grains.position = {Vec<3>(1.0, 1.0, 1.0), Vec<3>(1.93, 1.0, 1.0), Vec<3>(1.0, 1.99, 1.0)};
  find_contacts(state.packing);
  write_state(scratch.file("deep.h5"), state);
  const Outcome warned = run_floc("info deep.h5", scratch.path());
  EXPECT_EQ(warned.code, 0) << warned.err;
  EXPECT_THAT(warned.err, testing::HasSubstr("deep.h5: warning: 50 % of the contacts overlap by more than"));

  state.packing.grains.position[2][1] = 1.9;
  find_contacts(state.packing);
  write_state(scratch.file("deeper.h5"), state);
  const Outcome refused = run_floc("info deeper.h5", scratch.path());
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, testing::HasSubstr("the mean overlap of the contacts is 0.17 of a radius"));
}

struct BadBeads {
  const char *old, *replacement, *words;
};
class SpheresRefusal : public ::testing::TestWithParam<BadBeads> {};

TEST_P(SpheresRefusal, NamesWhatWasExpected) {
  const ScratchDirectory scratch;
  write_text(scratch.file("bad.toml"), exchanged(beads(), GetParam().old, GetParam().replacement));
  const Outcome check = run_floc("scene check bad.toml", scratch.path());
  EXPECT_NE(check.code, 0);
  EXPECT_THAT(check.err + check.out, testing::HasSubstr(GetParam().words));
}

TEST(SpheresScene, SaysOfAModelThatDoesNotFitThatAlone) {
  const ScratchDirectory scratch;
  write_text(scratch.file("bad.toml"), exchanged(beads(), "law = \"mindlin\"", "law = \"coulomb\""));
  const Outcome check = run_floc("scene check bad.toml", scratch.path());
  EXPECT_EQ(check.code, 4);
  EXPECT_THAT(check.err,
              testing::HasSubstr("the tangential stiffness of elastic spheres follows from Poisson's ratio"));
  EXPECT_EQ(std::count(check.err.begin(), check.err.end(), '\n'), 1) << check.err;
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, SpheresRefusal,
    testing::Values(BadBeads{"dimension = 3", "dimension = 2",
                             "law = \"hertz\": this model is for spheres; expected dimension = 3"},
                    BadBeads{"dimension = 3", "dimension = 4", "expected 2 or 3"},
                    BadBeads{"poisson = 0.3", "poisson = 0.5", "expected Poisson's ratio nu, in (-1, 0.5)"},
                    BadBeads{"{critical_fraction = 0.98}", "{restitution = 0.5}",
                             "the damping of elastic spheres follows the normal stiffness"},
                    BadBeads{"law = \"mindlin\", coefficient = 0.3", "coefficient = 0.3, stiffness = 1e5",
                             "the tangential stiffness of elastic spheres follows from Poisson's ratio"},
                    BadBeads{"law = \"hertz\", modulus = 70e9, poisson = 0.3",
                             "law = \"linear\", stiffness = 1e5", "expected contact.damping = {restitution}"},
                    BadBeads{"law = \"hertz\", modulus", "law = \"hertz\", stiffness = 1.0, modulus",
                             "the model \"hertz\" of contact.normal has no stiffness"},
                    BadBeads{"to = 10e6", "to = 10e9",
                             "expected at least 30, because softer spheres overlap too far"},
                    BadBeads{"solid_fraction = 0.45", "solid_fraction = 0.55",
                             "the solid fraction of the gas in (0, 0.49]"},
                    BadBeads{"friction = 0.02", "friction = -1",
                             "the friction coefficient during the assembly, a number >= 0"},
                    BadBeads{"friction = 0.02", "vibration = {dilation = 0.5, collisions = 5}",
                             "expected the factor by which all lengths grow, a number from 1 to 2"}));

}  // namespace
}  // namespace floc::test
