#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "floc/base/error.h"
#include "floc/prices/accuracy.h"
#include "floc/scene/read_scene.h"
#include "support/message_of.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kAskedScene = R"([scene]
dimension = 2
units = "reduced"
[grains]
count = 40
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e5}
adhesion = {law = "tail", force = 1.0, range = 1e-3}
[cell]
solid_fraction = 0.36
mass = 1
strain_rate_cap = 0.05
[assembly]
protocol = "aggregation"
agitation = 9.5
pressure = 0.01
[equilibrium]
finish = "auto"
)";

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return test::message_of([&] { (void)parse_scene(text, "s.toml", ".", overrides); });
}

TEST(AccuracyOfAScene, SetsWhatItChoosesAndSaysSoInItsText) {
  const Scene scene = parse_scene(kAskedScene + "[accuracy]\nphi = 0.01\nmoduli = 0.05\n", "s.toml", ".");
  const AccuracyChoice expected =
      choose_accuracy(*shipped_prices("disks-cohesive"), {{"phi", 0.01}, {"moduli", 0.05}});
  ASSERT_TRUE(expected.found()) << expected.failure_reason;
  EXPECT_EQ(NumericalSettings::of(scene.relaxation), expected.settings);
  EXPECT_EQ(scene.relaxation.tolerance.energy, expected.settings.energy());
  EXPECT_EQ(scene.accuracy, expected.name + ": " + expected.reason);
  // States store the text of the scene. If this text is read again, the result is the same scene; no new settings are
  // chosen.
  const Scene again = parse_scene(scene.text, "state", ".");
  EXPECT_EQ(NumericalSettings::of(again.relaxation), expected.settings);
  EXPECT_EQ(again.accuracy, scene.accuracy);
  EXPECT_EQ(again.text, scene.text);
}

TEST(AccuracyOfAScene, RefusesErrorsBelowThoseOfTheTable) {
  EXPECT_THAT(refusal(kAskedScene + "[accuracy]\nphi = 1e-14\n"),
              testing::AllOf(
                  HasSubstr("s.toml:21: accuracy.phi = 1e-14: expected at least"),
                  HasSubstr("which is the smallest error in the table shipped with floc for this quantity")));
  EXPECT_THAT(refusal(kAskedScene, {"accuracy.phi=1e-14"}), HasSubstr("--set accuracy.phi=1e-14: "));
}

TEST(AccuracyOfAScene, AsksForNothingWithoutAKeyNotWithAFaultyOne) {
  EXPECT_THAT(refusal(kAskedScene + "[accuracy]\n"), HasSubstr("[accuracy] requests no error"));
  for (const char* value : {"-0.01", "nan", "\"small\""})
    EXPECT_THAT(refusal(kAskedScene + "[accuracy]\nphi = " + value + "\n"),
                testing::AllOf(HasSubstr("accuracy.phi = "), Not(HasSubstr("requests no error"))));
}

TEST(AccuracyOfAScene, RefusesGrainsTheTableSaysNothingOf) {
  EXPECT_THAT(refusal(kAskedScene + "[accuracy]\nphi = 0.01\n", {"contact.normal.stiffness=1e9"}),
              HasSubstr("a K_N/F0 = 1e+09 is outside the range of the table of errors shipped with floc, which "
                        "was measured at 100000 and applies within a factor of ten"));
}

TEST(AccuracyOfAScene, RefusesATableOfAnotherKind) {
  const test::ScratchDirectory scratch;
  std::ofstream(scratch.file("beads.csv"))
      << "knob,value,observable,error_before_high,error_after_high,mean_difference,mean_error95,cost_ratio,"
         "tolerance,time_step,finish,patience,kappa,kind\n"
         "scene,as it is,phi,1e-3,1e-3,0,0,0.3,1e-5,0.28,auto,1,1e5,beads-hertz\n";
  try {
    (void)parse_scene(kAskedScene + "[accuracy]\nphi = 0.01\n", "s.toml", ".", {}, scratch.file("beads.csv"));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(
        error.what(),
        testing::AllOf(HasSubstr("s.toml:20: [accuracy]: the scene is of the kind disks-cohesive, but the "
                                 "table "),
                       HasSubstr("beads.csv describes scenes of the kind beads-hertz")));
  }
}

TEST(AccuracyOfAScene, IsChosenFromTheTableOfTheUser) {
  const test::ScratchDirectory scratch;
  std::ofstream(scratch.file("own.csv"))
      << "knob,value,observable,error_before_high,error_after_high,mean_difference,mean_error95,cost_ratio,"
         "tolerance,time_step,finish,patience,kappa,kind\n"
         "time_step,0.31,phi,1e-3,1e-3,0,0,0.3,1e-5,0.31,auto,1,1e5,disks-cohesive\n";
  const Scene scene =
      parse_scene(kAskedScene + "[accuracy]\nphi = 0.01\n", "s.toml", ".", {}, scratch.file("own.csv"));
  EXPECT_EQ(scene.relaxation.time_step, 0.31);
}

TEST(AccuracyOfAScene, CountsWhatItsCellAdds) {
  const std::string path = "[[load]]\nto = 1\nsteps_per_decade = 2\n[accuracy]\nphi = 0.05\n";
  // In kAskedScene, the cell has ten times the default mass during loading, and the default cap of the strain
  // rate.
  EXPECT_THAT(parse_scene(kAskedScene + path, "s.toml", ".").accuracy,
              HasSubstr("cell_mass at 10 times its default value"));
  EXPECT_THAT(parse_scene(kAskedScene + path, "s.toml", ".", {"load.0.cell_mass=0.1"}).accuracy,
              Not(HasSubstr("The total also includes")));
  EXPECT_THAT(parse_scene(kAskedScene + path, "s.toml", ".", {"assembly.strain_rate_cap=0.02"}).accuracy,
              HasSubstr("strain_rate_cap at 0.2 times its default value"));
}

TEST(AccuracyOfAScene, RefusesCellsTheTableSaysNothingOf) {
  const std::string path = "[[load]]\nto = 1\nsteps_per_decade = 2\n[accuracy]\nphi = 0.05\n";
  EXPECT_THAT(refusal(kAskedScene + path, {"cell.mass=2"}),
              HasSubstr("cell_mass is 20 times its default value on load paths, but the table shipped with "
                        "floc covers 0.1 to 10 times"));
  EXPECT_THAT(refusal(kAskedScene + path, {"load.0.inertial_number_cap=1e-3"}),
              HasSubstr("[accuracy]: strain_rate_cap is required in place of inertial_number_cap"));
}

TEST(AccuracyOfAScene, IsAskedForInsteadOfSettingsNotBesideThem) {
  const std::string asked = kAskedScene + "[accuracy]\nphi = 0.01\n";
  EXPECT_THAT(refusal(asked, {"run.time_step=0.2"}),
              HasSubstr("run.time_step is chosen by [accuracy]: expected either this key or [accuracy]"));
  EXPECT_THAT(refusal(asked, {"equilibrium.force=1e-4"}),
              HasSubstr("equilibrium.force is chosen by [accuracy]"));
  EXPECT_THAT(refusal(asked, {"equilibrium.finish=dynamic"}),
              HasSubstr("equilibrium.finish is chosen by [accuracy]"));
}

TEST(AccuracyOfAScene, RefusesOtherKeysAndEmptyWishes) {
  EXPECT_THAT(refusal(kAskedScene + "[accuracy]\n"),
              HasSubstr("[accuracy] requests no error: expected at least one of the keys phi, z, moduli"));
  EXPECT_THAT(refusal(kAskedScene + "[accuracy]\nphi = -1\n"),
              HasSubstr("expected a positive number (relative error)"));
  EXPECT_THAT(refusal(kAskedScene + "[accuracy]\nfi = 0.1\n"), HasSubstr("nearest valid key"));
}

/// The cheapest settings for an error of 10 % in lambda have a tolerance of 1e-2, which the pressure 0.01 of the demo is
/// not above.
TEST(AccuracyOfAScene, TakesAToleranceThatThePressuresOfTheSceneAllow) {
  const std::string demo = test::source_directory() + "/data/scenes/demo.toml";
  EXPECT_LT(read_scene(demo, {"accuracy.lambda=0.1"}).relaxation.tolerance.stress, 0.01);
}

/// Stages may change the law, so that their stiffness is outside of the table.
TEST(AccuracyOfAScene, RefusesStiffnessesThatAStageSets) {
  const std::string demo = test::source_directory() + "/data/scenes/demo.toml";
  for (const std::string set : {"normal.stiffness=2e6", "normal.stiffness=5e3", "adhesion.force=1e-3"})
    EXPECT_THROW(read_scene(demo, {"accuracy.phi=0.01", "load.1.set={" + set + "}"}), InputError) << set;
  EXPECT_NO_THROW(read_scene(demo, {"accuracy.phi=0.01", "load.1.set={normal.stiffness=2e5}"}));
}

}  // namespace
}  // namespace floc
