#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "floc/base/shell_word.h"
#include "floc/fitting/student_t.h"
#include "floc/io/csv.h"
#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

const std::string kDemoScene = source_directory() + "/data/scenes/demo.toml ";
/// Arguments for a scene whose small samples take a fraction of a second.
const std::string kQuick =
    source_directory() +
    "/data/scenes/type1_rolling_small.toml --set load.0.to=0.1 --set load.0.steps_per_decade=2 ";

const std::string kPriceColumns =
    "knob,value,observable,error_before_high,error_after_high,mean_difference,mean_error95,cost_ratio,"
    "tolerance,time_step,finish,patience,kappa";

class PlanCommand : public testing::Test {
 protected:
  const ScratchDirectory scratch_;

  Outcome plan(const std::string& arguments) const { return run_floc("plan " + arguments, scratch_.path()); }
  json rows(const std::string& arguments) const {
    const Outcome o = plan(arguments + " --format json");
    EXPECT_EQ(o.code, 0) << o.err;
    return o.code == 0 ? json::parse(o.out) : json::array();
  }
};

TEST_F(PlanCommand, KeepsBudgetsAndWants) {
  for (const char* budget : {"5s", "30min", "2 h", "3d"})
    for (const auto& row : rows(kDemoScene + "--cores 2 --budget '" + budget + "'")) {
      const double hours = std::string(budget) == "5s"      ? 5 / 3600.0
                           : std::string(budget) == "30min" ? 0.5
                           : std::string(budget) == "2 h"   ? 2.0
                                                            : 72.0;
      EXPECT_LE(row["wall_hours"], hours * (1 + 1e-9)) << budget;
      EXPECT_NEAR(double(row["error"]),
                  double(row["error_settings"]) + double(row["error_size"]) + double(row["error_scatter"]),
                  1e-9 * double(row["error"]));
    }
  const json wanted = rows(kDemoScene + "--want phi=0.01,B=0.1");
  ASSERT_GE(wanted.size(), 2u);
  for (const auto& row : wanted) EXPECT_LE(row["error"], row["observable"] == "phi" ? 0.01 : 0.1);
}

TEST_F(PlanCommand, ObservablesCanBeChosen) {
  for (const auto& row : rows(kDemoScene + "--budget 1h --observables phi,lambda"))
    EXPECT_TRUE(row["observable"] == "phi" || row["observable"] == "lambda");
}

TEST_F(PlanCommand, BadInputIsNamedAndNothingIsRunOrWritten) {
  const std::pair<std::string, std::string> refused[] = {
      {kDemoScene, "expected --budget (time that may be spent) or --want"},
      {"", "expected a scene file, or --check DIR"},
      {kDemoScene + "--budget 2m", "--budget 2m: expected a positive number with one of the units"},
      {kDemoScene + "--budget 1ms", "--budget 1ms: expected"},
      {kDemoScene + "--budget 0.01s", "a single sample of the smallest size, 50 grains, takes "},
      {kDemoScene + "--want K0=0.1", "K0 is not a quantity of this scene"},
      {kDemoScene + "--want phi=1e-9", "phi=1e-09: expected at least "},
      {kDemoScene + "--want phi=0.003 --budget 2s", "the nearest errors that the budget allows are phi="},
      {kDemoScene + "--budget 1h --set contact.normal.stiffness=1e9", "a K_N/F0 = 1e+09 is outside the range"},
      {kDemoScene + "--budget 1h --set cell.mass=100",
       "cell_mass is 1e+03 times its default value on load paths, but the table shipped with floc covers 0.1 "
       "to 10"},
      {kDemoScene + "--budget 1h --set accuracy.phi=0.01", "remove the table [accuracy]"},
      {kDemoScene + "--budget 1h --prices none.csv", "none.csv"},
      {kDemoScene + "--budget 1h --prices beads.csv",
       "the scene is of the kind disks-cohesive, but the table beads.csv describes scenes of the kind "
       "beads-hertz"},
      {kDemoScene + "--budget 1h --prices kindless.csv", "the table kindless.csv has no column kind"},
      {kDemoScene + "--budget 1h --prices newer.csv",
       "newer.csv:2: the value of column version is 2: expected 1"},
      {source_directory() + "/data/scenes/wide_span.toml --budget 1h",
       "The most similar kinds with a table are rigid-disks;"},
      {kDemoScene + "--budget 1h --prices old.csv", "old.csv: column"},
      {kDemoScene + "--budget 1h --pilot --set grains.count=1", "grains.count"},
      {kDemoScene + "--budget 1s --pilot",
       "--pilot: the samples of 200 grains would not be complete within 0.2 s of processor time"},
      {source_directory() + "/data/scenes/pentagons_shear_demo.toml --budget 60s --pilot",
       "expected a --budget of at least "},
      {"--check .", "this directory contains no campaign"},
      {kDemoScene + "--want lambda=0.3 --set load.0.to=1e-3", "lambda is not a quantity of this scene"},
      {source_directory() + "/data/scenes/oedometer.toml --want dilatancy=0.3",
       "dilatancy is not a quantity of"},
      {"- --budget 1h <" + kDemoScene, "expected the name of a scene file in place of -"},
      {kDemoScene + "--budget 5s --set 'equilibrium={softening=3}'",
       "--set equilibrium={softening=3}: the plan sets"},
  };
  write_text(scratch_.file("beads.csv"),
             kPriceColumns + ",kind\nscene,as it is,phi,1e-3,1e-3,0,0,0.3,1e-5,0.28,auto,1,1e5,beads-hertz\n");
  const std::string cells = "scene,as it is,phi,1e-3,1e-3,0,0,0.3,1e-5,0.28,auto,1,1e5";
  write_text(scratch_.file("kindless.csv"), kPriceColumns + "\n" + cells + "\n");
  write_text(scratch_.file("newer.csv"), kPriceColumns + ",kind,version\n" + cells + ",disks-cohesive,2\n");
  write_text(scratch_.file("old.csv"), "knob,value,observable\nscene,as it is,phi\n");
  for (const auto& [arguments, words] : refused) {
    const Outcome o =
        plan(arguments + (arguments.starts_with("--check") || arguments.empty() ? "" : " -o p.toml"));
    EXPECT_EQ(o.code, 4) << arguments << "\n" << o.err;
    EXPECT_THAT(o.err, HasSubstr(words)) << arguments;
    EXPECT_FALSE(std::filesystem::exists(scratch_.file("p.toml"))) << arguments;
  }
}

TEST_F(PlanCommand, NamesTheSettingsOfTheSceneThatItReplaces) {
  const std::string scenes = source_directory() + "/data/scenes/";
  const std::pair<std::string, std::vector<std::string>> replaced[] = {
      {kDemoScene + "--set equilibrium.patience=7", {"equilibrium.patience = 7 in the scene, = "}},
      {kDemoScene + "--set run.time_step=0.123 --set load.0.time_step=0.3",
       {"run.time_step = 0.123 in the scene, = ", "load.0.time_step = 0.3 in the scene, = "}},
      {kDemoScene + "--set equilibrium.force=1e-3", {"equilibrium.force = 0.001 in the scene, = "}},
      {scenes + "spheres_demo.toml --set assembly.softening=50 --set assembly.time_step=0.72",
       {"assembly.softening = 50 in the scene, = ", "assembly.time_step = 0.72 in the scene, = "}},
      {scenes + "rigid_disks_demo.toml --set dynamics.sweep_tolerance=1e-6",
       {"dynamics.sweep_tolerance = 1e-06 in the scene, = 0.001 in the plan"}},
  };
  for (const auto& [scene, words] : replaced) {
    const Outcome o = plan(scene + " --budget 1h --format csv");
    EXPECT_EQ(o.code, 0) << scene << "\n" << o.err;
    EXPECT_THAT(o.err, HasSubstr("the best plan replaces numerical settings of the scene: ")) << scene;
    for (const std::string& word : words) EXPECT_THAT(o.err, HasSubstr(word)) << scene;
    EXPECT_THAT(o.out, testing::Not(HasSubstr("scene,as it is"))) << scene;
  }
  EXPECT_THAT(plan(kDemoScene + "--budget 1h").err, testing::Not(HasSubstr("replaces")));
}

TEST_F(PlanCommand, ExtremeBudgetsGiveWordsAndNoHang) {
  for (const char* budget : {"1000y", "1e9y", "0.55s"}) {
    const Outcome o = plan(kDemoScene + "--budget " + budget);
    EXPECT_EQ(o.code, 0) << budget << o.err;
    EXPECT_THAT(o.err, HasSubstr("the best plan: ")) << budget;
  }
  EXPECT_THAT(plan(kDemoScene + "--budget 1000y").err, HasSubstr("the plan takes less than the budget"));
}

TEST_F(PlanCommand, WritesACampaignWhoseRunsItChecks) {
  ASSERT_EQ(plan(kQuick + "--set grains.count=70 --set grains.count=60 --want phi=0.03,B=0.5 -o p.toml").code,
            0);
  const Outcome made = run_floc("campaign plan p.toml -o p", scratch_.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(plan("--check p").err, HasSubstr("0 of 4 samples are done: expected at least two"));
  ASSERT_EQ(std::system(("cd " + scratch_.file("p") + " && snakemake --cores 2 >log 2>&1").c_str()), 0);
  std::map<std::string, json> checked;
  for (const auto& row : json::parse(plan("--check p --format json").out)) checked[row["quantity"]] = row;
  for (const char* quantity : {"phi", "B", "cost"}) {
    ASSERT_TRUE(checked.contains(quantity)) << quantity;
    const json& row = checked[quantity];
    EXPECT_EQ(row["n_samples"], 4);
    EXPECT_NEAR(row["ratio"], double(row["achieved"]) / double(row["promised"]), 1e-9);
  }
  EXPECT_LE(checked["phi"]["promised"], 0.03);
  // Without the table [plan], a campaign file does not contain the errors that the plan predicted.
  const std::string text = content_of(scratch_.file("p.toml"));
  write_text(scratch_.file("q.toml"), text.substr(0, text.find("[plan]")));
  ASSERT_EQ(run_floc("campaign plan q.toml -o q", scratch_.path()).code, 0);
  EXPECT_THAT(plan("--check q").err, HasSubstr("the campaign has no table [plan]"));
}

/// Files of plans are valid TOML whatever the names of the scene and of the table of prices.
TEST_F(PlanCommand, FilesNameScenesAndTablesWithQuotationMarks) {
  const std::string table = source_directory() + "/data/tables/tradeoff/disks-cohesive.csv";
  for (const std::string name : {"a'b", "a b", "a\"b", "a\\b"}) {
    write_text(scratch_.file(name + ".toml"), content_of(source_directory() + "/data/scenes/demo.toml"));
    write_text(scratch_.file(name + ".csv"), content_of(table));
    const std::string quoted = shell_quoted(name + ".toml"), prices = shell_quoted(name + ".csv");
    const Outcome made = plan(quoted + " --budget 5s -o p.toml --overwrite --prices " + prices);
    ASSERT_EQ(made.code, 0) << name << made.err;
    const Outcome checked = run_floc("campaign check p.toml", scratch_.path());
    EXPECT_EQ(checked.code, 0) << name << checked.err;
  }
}

/// Makes the runs of a plan, and returns the rows of floc plan --check by their quantities.
class CheckOfAPlan : public PlanCommand {
 protected:
  std::map<std::string, json> checked(const std::string& arguments) const {
    std::map<std::string, json> rows;
    const Outcome planned = plan(arguments + " -o c.toml");
    EXPECT_EQ(planned.code, 0) << planned.err;
    EXPECT_EQ(run_floc("campaign plan c.toml -o c", scratch_.path()).code, 0);
    EXPECT_EQ(std::system(("cd " + scratch_.file("c") + " && snakemake --cores 2 >log 2>&1").c_str()), 0)
        << content_of(scratch_.file("c/log"));
    const Outcome o = plan("--check c --format json");
    EXPECT_EQ(o.code, 0) << o.err;
    if (o.code == 0)
      for (const auto& row : json::parse(o.out)) rows[row["quantity"]] = row;
    return rows;
  }
};

TEST_F(CheckOfAPlan, ComparesEveryQuantityOfRigidGrains) {
  const auto rows = checked(source_directory() + "/data/scenes/rigid_disks_demo.toml --budget 2s");
  for (const char* quantity : {"phi", "z", "z_plus", "z_pairs", "Z2", "mobilised", "tail_plus", "rattlers"}) {
    ASSERT_TRUE(rows.contains(quantity)) << quantity;
    EXPECT_GE(rows.at(quantity)["n_samples"], 4) << quantity;
    EXPECT_FALSE(rows.at(quantity)["achieved"].is_null()) << quantity;
  }
}

/// Observables with the name of a column of another quantity must not be compared with this column: K0 is that of the
/// first loading, and not the mean of K0 over all states.
TEST_F(CheckOfAPlan, TakesTheValuesOfTestsFromTheirPaths) {
  const auto rows =
      checked(source_directory() + "/data/scenes/oedometer.toml --set load.0.steps_per_decade=3 --budget 6s");
  ASSERT_TRUE(rows.contains("K0"));
  double sum = 0.0, sum_z = 0.0, squares_z = 0.0;
  int n = 0;
  for (const auto& run : std::filesystem::directory_iterator(scratch_.file("c/runs/plan"))) {
    if (!run.is_directory()) continue;
    // The rows of the assembly and of the first stage of the load path.
    std::istringstream path(content_of(run.path().string() + "/path.csv"));
    std::string first_stage;
    for (std::string line; std::getline(path, line) && line.find(",unload,") == std::string::npos;)
      first_stage += line + "\n";
    write_text(scratch_.file("first.csv"), first_stage);
    const Outcome fit = run_floc("fit strength first.csv --format json", scratch_.path());
    ASSERT_EQ(fit.code, 0) << fit.err;
    sum += double(json::parse(fit.out)[0]["parameters"]["K0"]["value"]);
    std::istringstream whole(content_of(run.path().string() + "/path.csv"));
    const CsvTable states = CsvTable::parse("path.csv", whole);
    double z_minus = 0.0;
    for (int row = 0; row < states.n_rows(); ++row)
      z_minus += states.number(row, states.column("z_minus")) / states.n_rows();
    sum_z += z_minus;
    squares_z += z_minus * z_minus;
    ++n;
  }
  ASSERT_EQ(n, rows.at("K0")["n_samples"]);
  EXPECT_NEAR(rows.at("K0")["mean"], sum / n, 1e-6);
  // The achieved error is relative to the mean of the quantity itself. Contacts with hardly a force count in one of the
  // two tables alone.
  const double mean = sum_z / n, deviation = std::sqrt((squares_z - n * mean * mean) / (n - 1));
  EXPECT_NEAR(double(rows.at("z_minus")["mean"]) / mean, 1.0, 0.03);
  const double achieved = student_t_95(n - 1) * deviation / std::sqrt(n) / mean;
  EXPECT_NEAR(double(rows.at("z_minus")["achieved"]) / achieved, 1.0, 0.2);
  EXPECT_EQ(plan("--check c --columns quantity,ratio").code, 0);
}

TEST_F(PlanCommand, LeavesOutSettingsThatTheSceneRefuses) {
  // The tolerance must be below the first pressure of the scene, 1e-2.
  for (const auto& row : rows(kDemoScene + "--want phi=0.2")) EXPECT_LT(row["tolerance"], 1e-2);
}

TEST_F(PlanCommand, WritesASceneForASingleSample) {
  const Outcome o = plan(kDemoScene + "--budget 0.55s -o one.toml");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, AllOf(HasSubstr("1 sample of "), HasSubstr("you may run next: floc run one.toml")));
  EXPECT_EQ(run_floc("scene check one.toml", scratch_.path()).code, 0);
}

TEST_F(PlanCommand, APilotMeasuresScenesWithoutATable) {
  const std::string scene = kQuick + "--set grains.count=40 --set contact.normal.stiffness=2e6 ";
  EXPECT_THAT(plan(scene + "--budget 10min").err,
              HasSubstr("--pilot measures the costs and the scatter of this scene"));
  const Outcome o = plan(scene + "--budget 1min --pilot --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, AllOf(HasSubstr("pilot: a sample of 40 grains takes "),
                           HasSubstr("without a table of prices, the errors due to the numerical settings")));
  for (const auto& row : json::parse(o.out)) EXPECT_EQ(row["error"], row["error_scatter"]);
}

/// Sweeps that end early compact large packings by more than the small samples of the tables resolve.
TEST_F(PlanCommand, ChoosesNoLooseSweeps) {
  const std::string polyhedra = source_directory() + "/data/scenes/polyhedra_demo.toml ";
  for (const char* wish : {"--want phi=0.005", "--budget 1h", "--budget 60s"})
    for (const auto& row : rows(polyhedra + wish)) {
      EXPECT_FALSE(row["knob"] == "sweep_tolerance" && row["value"] != "1e-04") << wish << row;
      EXPECT_FALSE(row["knob"] == "together" && row["value"] != "careful") << wish << row;
    }
  // Only loose sweeps would seem to reach this error.
  const Outcome refused = plan(polyhedra + "--want phi=0.0014");
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, HasSubstr("phi=0.0014: expected at least 0.0039"));
}

TEST_F(PlanCommand, SaysWhereTheTableIsLessExactThanThePromise) {
  const Outcome o = plan(source_directory() + "/data/scenes/rolling_shear.toml --budget 1h --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("plan 1 (" + std::string(json::parse(o.out)[0]["knob"])));
  EXPECT_THAT(o.err, AllOf(HasSubstr("the table of prices knows the differences that these settings cause only "
                                     "within intervals that exceed the promised errors: "),
                           HasSubstr("critical_ratio +- 0.0")));
}

TEST_F(PlanCommand, DoesNotReplaceAFileUnlessToldSo) {
  write_text(scratch_.file("mine.toml"), "mine");
  const Outcome refused = plan(kDemoScene + "--budget 5s -o mine.toml");
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, HasSubstr("mine.toml: this file exists already; give --overwrite to replace it"));
  EXPECT_EQ(content_of(scratch_.file("mine.toml")), "mine");
  EXPECT_EQ(plan(kDemoScene + "--budget 5s --cores 3 -o mine.toml --overwrite").code, 0);
  EXPECT_THAT(content_of(scratch_.file("mine.toml")), HasSubstr("snakemake --cores 3\n"));
}

/// A plan and the campaign that makes it predict the same processor time.
TEST_F(PlanCommand, CampaignsPredictByTheSamePrices) {
  const std::pair<std::string, std::string> plans[] = {
      {kDemoScene, "--budget 30s --set grains.count=190"},
      {kDemoScene, "--want phi=0.02"},
      {source_directory() + "/data/scenes/rigid_disks_demo.toml ", "--budget 30s"},
      {source_directory() + "/data/scenes/polyhedra_demo.toml ", "--want phi=0.02"}};
  for (const auto& [scene, wish] : plans) {
    const Outcome made = plan(scene + wish + " --format json -o p.toml --overwrite");
    ASSERT_EQ(made.code, 0) << made.err;
    const double promised = 3600.0 * double(json::parse(made.out)[0]["cpu_hours"]);
    const Outcome checked = run_floc("campaign check p.toml --format json", scratch_.path());
    ASSERT_EQ(checked.code, 0) << checked.err;
    EXPECT_THAT(checked.err, HasSubstr("on one core (by the tables of prices of their kinds)"));
    double expected = 0.0;
    for (const auto& row : json::parse(checked.out)) expected += double(row["expected_seconds"]);
    EXPECT_NEAR(expected / promised, 1.0, 1e-3) << scene << wish;
  }
}

TEST_F(PlanCommand, SceneCheckPredictsByTheSamePrices) {
  const Outcome check = run_floc("scene check " + kDemoScene);
  EXPECT_THAT(check.err, HasSubstr("by the prices of the kind disks-cohesive, a run takes "));
  EXPECT_EQ(run_floc("scene check " + kDemoScene + "--prices none.csv").code, 4);
  for (const std::string command : {"scene check ", "run -o r "}) {
    const Outcome o = run_floc(
        command + kDemoScene + "--prices " + source_directory() + "/data/tables/tradeoff/rigid-disks.csv",
        scratch_.path());
    EXPECT_EQ(o.code, 4) << command;
    EXPECT_THAT(o.err, HasSubstr("describes scenes of the kind rigid-disks")) << command;
  }
  EXPECT_FALSE(std::filesystem::exists(scratch_.file("r")));
}

}  // namespace
}  // namespace floc::test
