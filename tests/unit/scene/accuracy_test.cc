#include "floc/scene/accuracy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/scene/read_scene.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kHeader =
    "knob,value,observable,error_before_high,error_after_high,mean_difference,mean_error95,cost_ratio,"
    "tolerance,"
    "time_step,"
    "finish,patience,kappa\n";

/// Three settings of growing cost, the reference last, and one of a parameter that no scene can set.
const std::string kTable = kHeader +
                           "strict,all,phi,0,0,0,0,1,1e-8,0.1,auto,2,1e5\n"
                           "strict,all,lambda,,,0,0,1,1e-8,0.1,auto,2,1e5\n"
                           "samples,1,phi,0,0,0,0,0.01,1e-8,0.1,auto,2,1e5\n"
                           "together,coarse,phi,1e-3,5e-2,0.03,0.02,0.1,1e-2,0.36,static,0.2,1e5\n"
                           "together,coarse,lambda,,,0.1,0.2,0.1,1e-2,0.36,static,0.2,1e5\n"
                           "tolerance,1e-4,phi,1e-5,1e-6,-0.05,0.03,0.2,1e-4,0.28,dynamic,1,1e5\n"
                           "tolerance,1e-4,lambda,,,0.1,0.01,0.2,1e-4,0.28,dynamic,1,1e5\n"
                           "scene,as it is,phi,2e-6,,0.001,0.02,0.3,1e-5,0.28,auto,1,1e5\n"
                           "scene,as it is,B,3e-3,4e-3,,,0.3,1e-5,0.28,auto,1,1e5\n"
                           "scene,as it is,G,1e-3,5e-3,,,0.3,1e-5,0.28,auto,1,1e5\n";

/// Cells other than the default's: cheap, since they are no choice.
const std::string kTableWithCells = kTable +
                                    "cell_mass,10 times,phi,1e-3,1e-4,-0.01,0.001,0.05,1e-5,0.28,auto,1,1e5\n"
                                    "cell_mass,2 times,phi,1e-4,2e-4,0,0.001,0.05,1e-5,0.28,auto,1,1e5\n"
                                    "cell_mass,0.1 times,phi,1e-6,1e-6,0,0.001,0.05,1e-5,0.28,auto,1,1e5\n"
                                    "strain_rate_cap,5 times,phi,1e-2,1e-3,0,0.001,0.05,1e-5,0.28,auto,1,1e5\n";

AccuracyChoice choice(const WantedAccuracy& wanted) {
  return choose_accuracy(read_accuracy_table(kTable, "table"), wanted);
}

AccuracyChoice choice_with(const std::vector<CellFactors>& cells, double phi) {
  return choose_accuracy(read_accuracy_table(kTableWithCells, "table"), {{"phi", phi}}, cells);
}

TEST(Accuracy, TheCheapestSettingWhoseErrorIsBelowIsTaken) {
  EXPECT_EQ(choice({{"phi", 5e-2}}).name, "together coarse");
  EXPECT_EQ(choice({{"phi", 4.9e-2}}).name, "tolerance 1e-4");
  const NumericalSettings coarse{1e-2, 0.36, Finish::statics, 0.2};
  EXPECT_EQ(choice({{"phi", 5e-2}}).settings, coarse);
}

TEST(Accuracy, ADifferenceOfMeansBeyondItsSamplingErrorCountsToo) {
  // 0.05 less 0.03 is 0.02, although single states are right to 1e-5.
  EXPECT_EQ(choice({{"phi", 2.1e-2}}).name, "tolerance 1e-4");
  EXPECT_EQ(choice({{"phi", 1.9e-2}}).name, "scene as it is");
}

TEST(Accuracy, AllThatIsAskedForHasToHold) {
  EXPECT_EQ(choice({{"phi", 1e-2}, {"moduli", 6e-3}}).name, "scene as it is");
  const AccuracyChoice none = choice({{"phi", 1e-2}, {"moduli", 4.9e-3}});
  EXPECT_FALSE(none.found());
  EXPECT_EQ(none.refused_key, "moduli");
  EXPECT_THAT(none.failure_reason, HasSubstr("expected at least 0.005"));
}

TEST(Accuracy, WhatIsFittedToAPathHasTheErrorOfItsMeanAndItsSampling) {
  EXPECT_EQ(choice({{"lambda", 0.31}}).name, "together coarse");
  EXPECT_EQ(choice({{"lambda", 0.12}}).name, "tolerance 1e-4");
  EXPECT_THAT(choice({{"lambda", 0.1}}).failure_reason, HasSubstr("expected at least 0.11"));
}

TEST(Accuracy, BelowAllMeasuredErrorsNothingIsGuaranteed) {
  // The reference, of error zero against itself, is no measure.
  EXPECT_EQ(choice({{"phi", 2e-6}}).name, "scene as it is");
  EXPECT_THAT(choice({{"phi", 1.9e-6}}).failure_reason, HasSubstr("expected at least 2e-06"));
}

TEST(Accuracy, TheCellAddsTheErrorOfTheNearestFactorMeasuredBeyondItsOwn) {
  // Without cells of its own a scene is asked nothing more, and cells are no choice, however cheap.
  EXPECT_EQ(choice_with({{}}, 5e-2).name, "together coarse");
  EXPECT_EQ(choice_with({{1.5, 1.0}}, 5.02e-2).name, "together coarse");
  EXPECT_NE(choice_with({{1.5, 1.0}}, 5.01e-2).name, "together coarse");
  // Means of 10 times differ by 0.01 +- 0.001: 0.009 more; 0.1 times as heavy, 1e-6.
  EXPECT_EQ(choice_with({{3.0, 1.0}}, 5.91e-2).name, "together coarse");
  EXPECT_NE(choice_with({{3.0, 1.0}}, 5.89e-2).name, "together coarse");
  EXPECT_EQ(choice_with({{0.1, 1.0}}, 5.0001e-2 + 1e-9).name, "together coarse");
  // Both parameters, of different parts of the run; the same of two parts counts once.
  EXPECT_EQ(choice_with({{2.0, 1.0}, {1.0, 5.0}, {2.0, 1.0}}, 6.03e-2).name, "together coarse");
  EXPECT_NE(choice_with({{2.0, 1.0}, {1.0, 5.0}, {2.0, 1.0}}, 6.01e-2).name, "together coarse");
}

TEST(Accuracy, WhatTheCellAddsIsSaidAndCountsForTheLeastError) {
  EXPECT_THAT(choice_with({{2.0, 1.0}}, 6e-2).reason,
              HasSubstr(". Added to these are the errors measured with cell_mass at 2 times its default value: "
                        "phi 2.0e-04 in 95 % of the states"));
  EXPECT_THAT(
      choice_with({{2.0, 1.0}}, 2.01e-4).failure_reason,
      HasSubstr("expected at least 0.0002, which is the smallest error in the table shipped with floc for this "
                "quantity with the mass and the strain rate of the cell that the scene gives"));
}

TEST(Accuracy, TheTableSpeaksForCellsBetweenThoseMeasured) {
  const auto table = read_accuracy_table(kTableWithCells, "table");
  EXPECT_TRUE(covers_cell(table, {1.0, 1.0}));
  EXPECT_TRUE(covers_cell(table, {10.0, 5.0}));
  EXPECT_TRUE(covers_cell(table, {0.01 / 0.1, 1.0}));
  EXPECT_FALSE(covers_cell(table, {10.1, 1.0}));
  EXPECT_FALSE(covers_cell(table, {0.09, 1.0}));
  EXPECT_FALSE(covers_cell(table, {1.0, 0.9})) << "slower cells were not measured";
}

TEST(Accuracy, WhatWasNotMeasuredIsNotGuaranteed) {
  EXPECT_THAT(choice({{"forces", 0.5}}).failure_reason, HasSubstr("has no error of this quantity"));
}

TEST(Accuracy, TheReasonNamesSettingsCostAndErrors) {
  EXPECT_EQ(
      choice({{"phi", 5e-2}}).reason,
      "finish static, time step 0.36, tolerance 0.01, patience 0.2: this takes 0.10 of the processor time of "
      "the "
      "strictest "
      "settings. "
      "Measured errors: phi 5.0e-02 in 95 % of the states, +3.0e-02 +- 2.0e-02 in means over samples after a "
      "collapse");
}

TEST(Accuracy, TheTableSpeaksForGrainsAboutAsStiff) {
  const auto table = read_accuracy_table(kTable, "table");
  EXPECT_TRUE(covers_stiffness(table, 1e4));
  EXPECT_TRUE(covers_stiffness(table, 1e6));
  EXPECT_FALSE(covers_stiffness(table, 9e3));
  EXPECT_FALSE(covers_stiffness(table, 1.1e6));
}

TEST(Accuracy, ATableThatIsNoneIsRefusedByLine) {
  const auto fails = [](const std::string& csv, const std::string& message) {
    try {
      (void)read_accuracy_table(csv, "t.csv");
      ADD_FAILURE() << csv;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
  };
  fails("knob,value\nscene,1\n", "t.csv:2: column finish is missing");
  fails(kHeader + "scene,x,phi,much,,,,0.3,1e-5,0.28,auto,1,1e5\n",
        "t.csv:2: the value of column error_before_high is much: expected a number");
}

TEST(Accuracy, TheShippedTableHasTheReferenceAndTheSceneItself) {
  const auto& table = shipped_accuracy_table();
  for (const char* parameter : {"strict", "scene", "together"})
    EXPECT_TRUE(std::any_of(table.begin(), table.end(), [&](const auto& row) {
      return row.parameter == parameter;
    })) << parameter;
}

// In scenes.

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
  try {
    (void)parse_scene(text, "s.toml", ".", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(AccuracyOfAScene, SetsWhatItChoosesAndSaysSoInItsText) {
  const Scene scene = parse_scene(kAskedScene + "[accuracy]\nphi = 0.01\nmoduli = 0.05\n", "s.toml", ".");
  const AccuracyChoice expected = choose_accuracy(shipped_accuracy_table(), {{"phi", 0.01}, {"moduli", 0.05}});
  ASSERT_TRUE(expected.found()) << expected.failure_reason;
  EXPECT_EQ(NumericalSettings::of(scene.relaxation), expected.settings);
  EXPECT_EQ(scene.relaxation.tolerance.energy, expected.settings.energy());
  EXPECT_EQ(scene.accuracy, expected.name + ": " + expected.reason);
  // A state carries that text: read again it is the same scene, without choosing anew.
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
  std::string cohesionless = kAskedScene;
  cohesionless.erase(cohesionless.find("adhesion"),
                     std::string("adhesion = {law = \"tail\", force = 1.0, range = 1e-3}").size());
  EXPECT_THAT(refusal(cohesionless + "[accuracy]\nphi = 0.01\n"),
              HasSubstr("requires a scene with contact.adhesion, because the errors in the table shipped with "
                        "floc were measured on cohesive grains"));
}

TEST(AccuracyOfAScene, CountsWhatItsCellAdds) {
  const std::string path = "[[load]]\nto = 1\nsteps_per_decade = 2\n[accuracy]\nphi = 0.05\n";
  // kAskedScene gives the cell of the path ten times the default mass, and the default cap.
  EXPECT_THAT(parse_scene(kAskedScene + path, "s.toml", ".").accuracy,
              HasSubstr("cell_mass at 10 times its default value"));
  EXPECT_THAT(parse_scene(kAskedScene + path, "s.toml", ".", {"load.0.cell_mass=0.1"}).accuracy,
              Not(HasSubstr("Added to these")));
  EXPECT_THAT(parse_scene(kAskedScene + path, "s.toml", ".", {"assembly.strain_rate_cap=0.02"}).accuracy,
              HasSubstr("strain_rate_cap at 0.2 times its default value"));
}

TEST(AccuracyOfAScene, RefusesCellsTheTableSaysNothingOf) {
  const std::string path = "[[load]]\nto = 1\nsteps_per_decade = 2\n[accuracy]\nphi = 0.05\n";
  EXPECT_THAT(
      refusal(kAskedScene + path, {"cell.mass=2"}),
      HasSubstr("the mass of the cell is 20 times the default mass on load paths, and its strain_rate_cap is 1 "
                "times the default; this is outside the range of the table of errors shipped with floc"));
  EXPECT_THAT(refusal(kAskedScene + path, {"load.0.inertial_number_cap=1e-3"}),
              HasSubstr("[accuracy] requires strain_rate_cap in place of inertial_number_cap"));
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

}  // namespace
}  // namespace floc
