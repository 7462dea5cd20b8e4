#include <fmt/format.h>
#include <fnmatch.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "floc/io/csv.h"
#include "support/small_campaign.h"

namespace floc::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kTables[] = {"runs.csv", "means.csv", "fits.csv"};

/// Fixture: a scratch directory that contains the small scene.
class Campaigns : public testing::Test {
 protected:
  void SetUp() override { write_text(file("small.toml"), small_scene()); }
  std::string file(const std::string& name) const { return scratch_.file(name); }
  Outcome floc(const std::string& arguments) const { return run_floc(arguments, scratch_.path()); }
  void plan(const std::string& text, const std::string& directory) const {
    write_text(file(directory + ".toml"), text);
    const Outcome o = floc("campaign plan " + directory + ".toml -o " + directory);
    ASSERT_EQ(o.code, 0) << o.err;
  }

  ScratchDirectory scratch_;
};

/// Fixture of the tests that need snakemake. The small campaign is run once, in the directory whole/.
class CampaignOnSnakemake : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!has_snakemake()) return;
    scratch_ = new ScratchDirectory;
    write_text(file("small.toml"), small_scene());
    write_text(file("whole.toml"), small_campaign());
    const Outcome planned = floc("campaign plan whole.toml -o whole");
    ASSERT_EQ(planned.code, 0) << planned.err;
    whole_ = snakemake(file("whole"));
  }
  static void TearDownTestSuite() { delete scratch_; }
  void SetUp() override {
    if (!has_snakemake())
      GTEST_SKIP() << "NOT TESTED: snakemake is not installed, so no campaign was run (.ci/deps installs it)";
  }
  static std::string file(const std::string& name) { return scratch_->file(name); }
  static Outcome floc(const std::string& arguments) { return run_floc(arguments, scratch_->path()); }

  inline static ScratchDirectory* scratch_ = nullptr;
  inline static Outcome whole_;
};

/// Returns the number in the column `column` of a row of a table. The row is the first one that contains the given
/// texts.
/// @param row  texts to look for; the key is the name of a column
double number_at(const CsvTable& table, const std::map<std::string, std::string>& row,
                 const std::string& column) {
  for (int k = 0; k < table.n_rows(); ++k) {
    const auto agrees = [&](const auto& cell) {
      return table.text(k, table.column(cell.first)) == cell.second;
    };
    if (std::ranges::all_of(row, agrees)) return table.number(k, table.column(column));
  }
  ADD_FAILURE() << "no such row of " << table.place();
  return NAN;
}

TEST_F(CampaignOnSnakemake, MakesTwelveRunsTheirTablesAndAPage) {
  ASSERT_EQ(whole_.code, 0) << whole_.out;
  EXPECT_THAT(whole_.out, HasSubstr("floc: all 12 runs are done"));
  const CsvTable runs = CsvTable::read(file("whole/runs.csv"));
  EXPECT_THAT(runs.columns(),
              ElementsAre("case", "contact.friction.coefficient", "contact.rolling.coefficient", "seed", "step",
                          "branch", "P_star", "phi", "z", "B", "n_negative", "kept_share"));
  EXPECT_EQ(runs.n_rows(), 12 * 9);  // 12 runs with 9 states each
  EXPECT_THAT(content_of(file("whole/index.html")), HasSubstr("12 of 12 runs are done"));
  EXPECT_EQ(CsvTable::read(file("whole/outcomes.csv")).n_rows(), 12);
  EXPECT_THAT(snakemake(file("whole")).out, HasSubstr("Nothing to be done"));
}

TEST_F(CampaignOnSnakemake, DescribesTheColumnsOfItsTables) {
  std::map<std::string, std::vector<std::string>> described;
  const Outcome reference = floc("help columns campaign --format json");
  for (const auto& row : nlohmann::json::parse(reference.out))
    described[row.at("table")].push_back(row.at("column"));
  const auto is_described = [&](const std::string& table, const std::string& column) {
    return std::ranges::any_of(described.at(table), [&](const std::string& name) {
      return ::fnmatch(name.c_str(), column.c_str(), 0) == 0;
    });
  };
  const std::set<std::string> collected = {"phi", "z", "B", "n_negative", "kept_share"};
  for (const char* name : {"runs", "means", "fits", "outcomes"}) {
    const CsvTable table = CsvTable::read(file(fmt::format("whole/{}.csv", name)));
    for (const std::string& column : table.columns())
      EXPECT_TRUE(collected.contains(column) ||
                  is_described(fmt::format("campaign collect --table {}", name), column))
          << name << " has " << column << ", which is not described";
  }
  const std::pair<const char*, std::string> printed[] = {
      {"campaign check", floc("campaign check whole.toml").out},
      {"campaign outcome", floc("campaign outcome whole").out},
      {"campaign page", floc("campaign page whole -o p.html").out}};
  for (const auto& [name, text] : printed) {
    std::istringstream in(text);
    const CsvTable table = CsvTable::parse(name, in);
    for (const std::string& column : table.columns())
      EXPECT_TRUE(is_described(name, column)) << name << " has " << column << ", which is not described";
  }
}

TEST_F(CampaignOnSnakemake, TakesMeansOverTheSeeds) {
  const CsvTable means = CsvTable::read(file("whole/means.csv"));
  const std::string label = "friction.coefficient=0.5_rolling.coefficient=0.005";
  double sum = 0.0, squares = 0.0;
  for (const char* seed : {"1", "2", "3"}) {
    const CsvTable path = CsvTable::read(file("whole/runs/" + label + "/seed-" + seed + "/path.csv"));
    const double phi = number_at(path, {{"step", "7"}}, "phi");
    sum += phi;
    squares += phi * phi;
  }
  const std::map<std::string, std::string> row = {{"case", label}, {"step", "7"}, {"quantity", "phi"}};
  EXPECT_NEAR(number_at(means, row, "mean"), sum / 3, 1e-14);
  const double deviation = std::sqrt((squares - sum * sum / 3) / 2);
  EXPECT_NEAR(number_at(means, row, "deviation"), deviation, 1e-8);
  EXPECT_NEAR(number_at(means, row, "stderr"), deviation / std::sqrt(3.0), 1e-8);
  EXPECT_EQ(number_at(means, row, "n"), 3);
  // `floc moduli` prints the same B for the single state.
  const Outcome alone = floc("moduli --columns B whole/runs/" + label + "/seed-2/state-0007.h5");
  EXPECT_EQ(
      number_at(CsvTable::read(file("whole/runs.csv")), {{"case", label}, {"seed", "2"}, {"step", "7"}}, "B"),
      std::stod(alone.out.substr(alone.out.find('\n'))));
}

TEST_F(CampaignOnSnakemake, JudgesMeansByTheirReference) {
  const CsvTable means = CsvTable::read(file("whole/means.csv"));
  int n_phi = 0, n_z = 0;
  for (int k = 0; k < means.n_rows(); ++k) {
    const auto number = [&](const char* column) { return means.number(k, means.column(column)); };
    if (means.text(k, means.column("source")).empty()) continue;
    const bool of_phi = means.text(k, means.column("quantity")) == "phi";
    (of_phi ? n_phi : n_z) += 1;
    EXPECT_NEAR(number("difference"), number("mean") - number("reference"), 1e-15);
    const double s_ref = number("reference_deviation"), n_ref = number("reference_n");
    EXPECT_NEAR(number("allowed"),
                2.6 * std::sqrt(std::pow(number("deviation"), 2) / number("n") + s_ref * s_ref / n_ref), 1e-12);
    EXPECT_EQ(means.text(k, means.column("agrees")), of_phi ? "false" : "true");
  }
  EXPECT_EQ(n_phi, 2);  // only the cases with friction 0.5
  EXPECT_EQ(n_z, 4);
}

TEST_F(CampaignOnSnakemake, KilledAndTakenUpAgainGivesTheSameTables) {
  ASSERT_EQ(floc("campaign plan whole.toml -o broken").code, 0);
  const std::string place = file("broken");
  // Kills snakemake at a time when some runs are complete, some are in progress and some have not been started.
  pid_t engine = start_snakemake(place, "--cores 2");
  const auto n_done = [&] {
    int n = 0;
    for (const auto& entry : fs::recursive_directory_iterator(place))
      n += entry.path().filename() == "outcome.csv";
    return n;
  };
  while (n_done() < 3 || processes_in(place, "campaign run").empty()) ::usleep(2000);
  ::kill(engine, SIGKILL);
  (void)wait_for(engine);
  for (int k = 0; k < 5000 && !processes_in(place, " run scene.toml").empty(); ++k) ::usleep(2000);
  EXPECT_THAT(processes_in(place, " run scene.toml"), ElementsAre())
      << "runs outlive the snakemake that was killed";
  EXPECT_LT(n_done(), 12);

  // Kills one `floc run` while snakemake continues.
  EXPECT_EQ(snakemake(place, "--unlock").code, 0);
  engine = start_snakemake(place, "--cores 2 --rerun-incomplete");
  std::vector<pid_t> running;
  while ((running = processes_in(place, "floc run scene.toml")).empty()) ::usleep(1000);
  ::kill(running.front(), SIGKILL);
  const int status = wait_for(engine);
  const std::string said = content_of(place + ".snakemake");
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) != 0) << said;
  EXPECT_THAT(said, AllOf(HasSubstr("1 of 12 runs failed"), HasSubstr("ended by signal 9")));
  EXPECT_EQ(n_done(), 11);

  const Outcome last = snakemake(place);
  EXPECT_EQ(last.code, 0) << last.out;
  for (const char* table : kTables)
    EXPECT_EQ(content_of(place + "/" + table), content_of(file(std::string("whole/") + table))) << table;
}

TEST_F(CampaignOnSnakemake, ARunThatFailsIsListedAndStopsNoOther) {
  std::string text = small_campaign().substr(0, small_campaign().find("[[reference]]"));
  text.replace(text.find("contact.rolling.coefficient = [0.005, 0.01]"), 43,
               "equilibrium.max_time = [1.0, 1e6]");
  text.replace(text.find("1..3"), 4, "2..3");
  write_text(file("some.toml"), text);
  ASSERT_EQ(floc("campaign plan some.toml -o some").code, 0);
  const Outcome o = snakemake(file("some"));
  EXPECT_EQ(o.code, 1);
  const std::string failed = "runs/coefficient=0.2_max_time=1/seed-2";
  EXPECT_THAT(o.out,
              AllOf(HasSubstr("4 of 8 runs failed"), HasSubstr(failed + ": floc run failed with exit code 3: "),
                    HasSubstr("did not converge")));
  const CsvTable runs = CsvTable::read(file("some/runs.csv"));
  EXPECT_EQ(runs.n_rows(), 4 * 9);
  EXPECT_THAT(content_of(file("some/index.html")),
              AllOf(HasSubstr("Runs that failed"), HasSubstr("did not converge")));
  EXPECT_THAT(content_of(file("some/outcomes.csv")), HasSubstr("failed,3,run,"));
  EXPECT_FALSE(fs::exists(file("some/complete")));
  const Outcome listed = floc("campaign outcome some --format csv");
  EXPECT_EQ(listed.code, 3);
  EXPECT_THAT(listed.out, HasSubstr("coefficient=0.2_max_time=1,2,failed,3,run,"));
  EXPECT_THAT(listed.err, HasSubstr("4 of 8 runs failed"));
  // A second run of snakemake repeats only the runs that failed.
  const Outcome again = snakemake(file("some"), "--cores 1 --dry-run --quiet");
  EXPECT_THAT(again.out, AllOf(HasSubstr("run_1 "), HasSubstr("run_2 "), Not(HasSubstr("run_3 "))));
}

TEST_F(CampaignOnSnakemake, MoreSeedsMakeNoRunAgain) {
  std::string text = small_campaign();
  text.replace(text.find("contact.rolling.coefficient = [0.005, 0.01]"), 43,
               "contact.rolling.coefficient = [0.005]");
  text.replace(text.find("1..3"), 4, "1..2");
  write_text(file("more.toml"), text);
  ASSERT_EQ(floc("campaign plan more.toml -o more").code, 0);
  ASSERT_EQ(snakemake(file("more")).code, 0);
  text.replace(text.find("1..2"), 4, "1..3");
  write_text(file("more.toml"), text);
  const Outcome refused = floc("campaign plan more.toml -o more");
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("more/campaign.toml"), HasSubstr("--overwrite")));
  ASSERT_EQ(floc("campaign plan more.toml -o more --overwrite").code, 0);
  const Outcome more = snakemake(file("more"), "--cores 1 --dry-run --quiet");
  EXPECT_THAT(more.out, AllOf(HasSubstr("run_3 "), HasSubstr("run_6 "), Not(HasSubstr("run_1 ")),
                              Not(HasSubstr("run_2 ")), Not(HasSubstr("run_5 "))));
}

TEST_F(Campaigns, StartFromACommentedFile) {
  const Outcome made = floc("campaign new sweep");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(fs::exists(file("sweep.toml")) && fs::exists(file("sweep-scene.toml")));
  const Outcome checked = floc("campaign check sweep.toml --format csv");
  EXPECT_EQ(checked.code, 0) << checked.err;
  std::istringstream in(checked.out);
  const CsvTable table = CsvTable::parse("stdout", in);
  EXPECT_THAT(table.columns(), ElementsAre("case", "contact.friction.coefficient", "seed", "n_states",
                                           "expected_seconds", "directory"));
  EXPECT_EQ(table.n_rows(), 6);
  EXPECT_THAT(checked.err, HasSubstr("2 cases with 3 seeds: 6 runs, expected to take"));
  EXPECT_EQ(floc("campaign new sweep").code, 4);
  fs::create_directory(file("below"));
  ASSERT_EQ(floc("campaign new below/own --scene small.toml").code, 0);
  EXPECT_THAT(content_of(file("below/own.toml")), HasSubstr("scene = \"../small.toml\""));
}

TEST_F(Campaigns, HaveARuleARunWithSceneChangesAndSeed) {
  plan(small_campaign(), "planned");
  const std::string rules = content_of(file("planned/Snakefile"));
  for (const char* part :
       {"rule run_12:", "campaign run scene.toml --with-parent --seed 3 ",
        "--set 'contact.friction.coefficient=0.5'", "--set 'contact.rolling.coefficient=0.01'",
        "-o 'runs/friction.coefficient=0.5_rolling.coefficient=0.01/seed-3'",
        "--table '2-moduli.csv: moduli state-0004.h5 state-0007.h5'",
        "--table '0008-3-compare.csv: compare state-0001.h5 state-0008.h5'", "rule table_means:", "rule page:"})
    EXPECT_THAT(rules, HasSubstr(part));
  EXPECT_THAT(rules, Not(HasSubstr("run_13")));
  // plans the campaign a second time; the seeds are given as a list
  EXPECT_EQ(floc("campaign plan planned.toml -o planned").code, 0);
  EXPECT_EQ(content_of(file("planned/campaign.toml")), small_campaign());
}

TEST_F(Campaigns, TakeTheListOfDiametersAndTheStateOfASceneAlong) {
  ASSERT_EQ(floc("run small.toml --until 1 -o start").code, 0);
  fs::create_directory(file("scenes"));
  std::string scene = small_scene();
  const std::size_t assembly = scene.find("protocol = \"aggregation\""), load = scene.find("[[load]]");
  scene.replace(assembly, load - assembly,
                "protocol = \"state\"\nstate = \"../start/state-0001.h5\"\npressure = 0.01\n");
  scene.erase(scene.find("[cell]\nsolid_fraction = 0.5\n") + 7, 21);
  scene.erase(scene.find("[grains]"), scene.find("[contact]") - scene.find("[grains]"));
  write_text(file("scenes/from.toml"), scene);
  write_text(file("scenes/c.toml"),
             "[campaign]\nscene = \"from.toml\"\nseeds = [1]\n[[collect]]\ntable = \"path\"\n"
             "columns = [\"phi\"]\n");
  const Outcome planned = floc("campaign plan scenes/c.toml -o planned");
  ASSERT_EQ(planned.code, 0) << planned.err;
  const Outcome ran = floc("campaign run planned/scene.toml --seed 1 -o planned/runs/base/seed-1");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(content_of(file("planned/runs/base/seed-1/outcome.csv")), HasSubstr("\n0,"));
}

/// Text of a campaign of one run, with a fit.
std::string single_run_campaign() {
  return "[campaign]\nscene = \"small.toml\"\nseeds = [1]\n[[collect]]\ntable = \"path\"\ncolumns = [\"phi\"]\n"
         "[[fit]]\nlaw = \"consolidation\"\n";
}

TEST_F(Campaigns, AcceptTheOptionsThatTheirCommandsAccept) {
  std::string text = single_run_campaign() + "options = [\"--law\", \"log\", \"--window\", \"0.1,1\"]\n";
  text +=
      "[[collect]]\ntable = \"moduli\"\ncolumns = [\"B\"]\noptions = [\"--strains full\", \"--prestress\"]\n";
  text += "[[collect]]\ntable = \"compare\"\ncolumns = [\"kept_share\"]\nbefore = {step = 1}\n";
  text += "options = [\"--rigid-tolerance\", \"0.02\"]\n";
  write_text(file("c.toml"), text);
  const Outcome o = floc("campaign check c.toml");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("no errors found; 1 case with 1 seed: 1 run, expected"));
}

TEST_F(Campaigns, AFitThatFailsIsInTheExitCodesAndOnThePage) {
  plan(single_run_campaign(), "planned");
  ASSERT_EQ(floc("campaign run planned/scene.toml --seed 1 -o planned/runs/base/seed-1").code, 0);
  // campaign plan refuses this option, so it is added to the file in the directory of the campaign.
  const std::string wrong = single_run_campaign() + "options = [\"--law\", \"foo\"]\n";
  write_text(file("planned/campaign.toml"), wrong);
  const Outcome fits = floc("campaign collect planned --table fits --format csv");
  EXPECT_EQ(fits.code, 2);
  EXPECT_THAT(fits.err,
              HasSubstr("case base: floc fit consolidation failed with exit code 2: --law: foo not in"));
  EXPECT_EQ(floc("campaign collect planned --table fits --keep-going").code, 0);
  const Outcome outcome = floc("campaign outcome planned --format csv");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.out, HasSubstr("base,,failed,2,fit consolidation,\"--law: foo not in"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("the only run is done"), HasSubstr("1 fit failed")));
  for (const std::string table : {"runs", "means", "fits", "outcomes"})
    write_text(file("planned/" + table + ".csv"),
               floc("campaign collect planned --format csv --table " + table).out);
  ASSERT_EQ(floc("campaign page planned -o p.html").code, 0);
  EXPECT_THAT(
      content_of(file("p.html")),
      AllOf(HasSubstr("Fits without a result"), HasSubstr("--law: foo not in"),
            HasSubstr("fits/base-1-consolidation.log"), HasSubstr("1 case with 1 seed; 1 of 1 run is done.")));
  // After the option has been corrected, the failure is gone.
  write_text(file("planned/campaign.toml"), single_run_campaign() + "options = [\"--law\", \"log\"]\n");
  (void)floc("campaign collect planned --table fits");
  EXPECT_EQ(floc("campaign outcome planned").code, 0);
}

TEST_F(Campaigns, AFitWithoutAResultIsOnThePageButIsNoFailedFit) {
  // The runs of this campaign never unload, so that the elastic law cannot be fitted.
  std::string scene = small_scene();
  const std::size_t unload = scene.find("[[load]]\nname = \"unload\"");
  scene.erase(unload, scene.find("[run]") - unload);
  write_text(file("loading.toml"), scene);
  std::string text = single_run_campaign();
  text.replace(text.find("small.toml"), 10, "loading.toml");
  text.replace(text.find("consolidation"), 13, "elastic");
  plan(text, "planned");
  ASSERT_EQ(floc("campaign run planned/scene.toml --seed 1 -o planned/runs/base/seed-1").code, 0);
  EXPECT_EQ(floc("campaign collect planned --table fits").code, 3);
  const Outcome outcome = floc("campaign outcome planned");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string table : {"runs", "means", "fits", "outcomes"})
    write_text(file("planned/" + table + ".csv"),
               floc("campaign collect planned --format csv --table " + table).out);
  ASSERT_EQ(floc("campaign page planned -o p.html").code, 0);
  EXPECT_THAT(content_of(file("p.html")),
              AllOf(HasSubstr("Fits without a result"),
                    HasSubstr("no modulus can be fitted: the pressure never falls")));
}

TEST_F(Campaigns, KeepTheReasonAndTheExitCodeOfACommandLineThatIsNotValid) {
  plan(single_run_campaign(), "planned");
  ASSERT_EQ(floc("campaign run planned/scene.toml --seed 1 -o planned/runs/base/seed-1 --table "
                 "'1-moduli.csv: moduli state-0001.h5 --foo'")
                .code,
            0);
  EXPECT_THAT(content_of(file("planned/runs/base/seed-1/outcome.csv")),
              AllOf(HasSubstr("floc moduli has no option --foo"), Not(HasSubstr("Run with --help"))));
  EXPECT_EQ(floc("campaign outcome planned").code, 2);
}

TEST_F(Campaigns, MessagesAboutAPlannedFileNameNoOptionThatNobodyGave) {
  plan(single_run_campaign(), "planned");
  write_text(file("planned/campaign.toml"), "");
  const Outcome o = floc("campaign outcome planned");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, AllOf(HasSubstr("campaign.toml:1: campaign is missing"), Not(HasSubstr("--set"))));
}

TEST_F(Campaigns, OfBadFilesAreRefusedWithLineKeyAndWhatIsExpected) {
  const std::string head = "[campaign]\nscene = \"small.toml\"\nseeds = \"1..2\"\n";
  const std::string phi = "[[collect]]\ntable = \"path\"\ncolumns = [\"phi\"]\n";
  const std::pair<std::string, std::vector<const char*>> bad[] = {
      {"", {"c.toml:1: campaign is missing: expected a table with the keys scene and seeds"}},
      {"[campaign\n", {"c.toml:1: "}},
      {"[campaign]\nscene = \"absent.toml\"\nseeds = \"1..2\"\n" + phi,
       {"c.toml:2: campaign.scene = ", "expected a scene file; there is no ", "absent.toml"}},
      {"[campaign]\nscene = \"small.toml\"\nseeds = \"5..2\"\n" + phi,
       {"c.toml:3: campaign.seeds = ", "expected A..B"}},
      {"[campaign]\nscene = \"small.toml\"\nseeds = [1, -2]\n" + phi,
       {"c.toml:3: campaign.seeds", "whole numbers >= 0"}},
      {"[campaign]\nscene = \"small.toml\"\nseeds = [1, 1]\n" + phi, {"c.toml:3: campaign.seeds has 1 twice"}},
      {head, {"c.toml: this campaign collects no results: expected a [[collect]] or a [[fit]]"}},
      {head + "sead = 1\n" + phi,
       {"c.toml:4: unknown key campaign.sead; the nearest valid key in [campaign] is se"}},
      {head + phi + "[gird]\n", {"c.toml:7: unknown key gird; the nearest valid key is grid"}},
      {head + "[grid]\ncontact.friction.coefficient = 0.3\n" + phi,
       {"c.toml:5: grid.contact.friction.coefficient = 0.3: expected a list of one or more values"}},
      {head + "[grid]\ngrains.count = [20]\ncontact.friction.coefficient = [0.3, -1]\n" + phi,
       {"c.toml:6: case ", "contact.friction.coefficient = -1: expected"}},
      {head + "[[case]]\nset = {contact.friktion.coefficient = 1}\n" + phi,
       {"c.toml:5: case ", "unknown key contact.friktion; the nearest valid key in [contact] is friction"}},
      {head + "[[case]]\nname = \"a\"\n" + phi, {"c.toml:4: case.1.set is missing: expected a table of keys"}},
      {head + "[[collect]]\ntable = \"paths\"\ncolumns = [\"phi\"]\n",
       {"c.toml:5: collect.1.table = ",
        "expected \"path\", \"moduli\", \"network\", \"structure\" or \"compare\""}},
      {head + "[[collect]]\ntable = \"path\"\ncolumns = [\"fi\"]\n",
       {"c.toml:4: columns = fi: the table path.csv has no column of this name; the nearest is "}},
      {head + "[[collect]]\ntable = \"path\"\n", {"c.toml:4: collect.1.columns is missing: expected a list"}},
      {head + phi + "states = {P_star = 0.3}\n",
       {"c.toml:7: P_star = 0.3: expected one of the pressures that case base reaches: 0, 0.01, 0.02154, "}},
      {head + phi + "states = {branch = \"laod\", P_star = 0.1}\n",
       {"c.toml:7: branch = laod: case base has no state"}},
      {head + phi + "states = {step = [0, 9]}\n",
       {"c.toml:7: step = 9: the states of case base have the numbers 0 to 8"}},
      {head + phi + "states = \"first\"\n",
       {"c.toml:7: collect.1.states = ", "expected \"all\", \"last\", {step = "}},
      {head + "[[collect]]\ntable = \"compare\"\ncolumns = [\"n_kept\"]\n",
       {"c.toml:4: collect.1.before: expected the one state to compare with"}},
      {head + phi + "[[collect]]\ntable = \"moduli\"\ncolumns = [\"phi\"]\n",
       {"c.toml:7: columns has phi, which is already collected from path (",
        "c.toml:4): expected each column from one table"}},
      {head + phi + "[[fit]]\nlaw = \"cycle\"\n", {"c.toml:8: fit.1.law = ", "expected \"consolidation\""}},
      {head + phi + "[[fit]]\nlaw = \"consolidation\"\noptions = [\"--law\", \"foo\"]\n",
       {"c.toml:7: options = [\"--law\", \"foo\"]: floc fit consolidation does not accept these options: "
        "--law: foo "
        "not in "}},
      {head + phi + "[[fit]]\nlaw = \"consolidation\"\noptions = [\"--phi-limit\", \"dense\"]\n",
       {"c.toml:7: options", "--phi-limit: \"dense\": expected a positive solid fraction"}},
      {head + phi + "[[fit]]\nlaw = \"elastic\"\noptions = [\"--format\", \"json\"]\n", {"c.toml:7: options"}},
      {head + "[[collect]]\ntable = \"moduli\"\ncolumns = [\"B\"]\noptions = [\"--foo\"]\n" +
           "[[collect]]\ntable = \"network\"\ncolumns = [\"z\"]\noptions = [\"--help\"]\n",
       {"c.toml:4: options = [\"--foo\"]: floc moduli does not accept these options: floc moduli has no option "
        "--foo",
        "c.toml:8: options = [\"--help\"]: floc network does not accept these options: the command prints its "
        "help"}},
      {head + phi + "[[reference]]\nof = \"z\"\nstate = \"last\"\nvalue = 1\nsource = \"\"\n",
       {"c.toml:7: of = \"z\": expected a column that a [[collect]] names"}},
      {head + phi + "[[reference]]\nof = \"phi\"\nvalue = 1\n",
       {"c.toml:7: reference.1.state is missing",
        "reference.1.source is missing: expected the source of the value, such as a publication"}},
      {head + phi + "[[reference]]\nof = \"phi\"\nstate = \"last\"\nvalue = 1\nsource = \"x\"\n" +
           "[[reference]]\nof = \"phi\"\nstate = \"last\"\nvalue = 1\n",
       {"c.toml:12: reference.2.source is missing"}},
      {head + phi + "[[reference]]\nof = \"phi\"\nstate = \"last\"\nvalue = 1\nerror = -1\nsource = \"x\"\n",
       {"c.toml:11: reference.1.error = -1: expected a number >= 0"}},
      {head + phi + "[[reference]]\nof = \"phi\"\nstate = \"all\"\nvalue = 1\nsource = \"x\"\n",
       {"c.toml:9: state: several states are selected: expected the one state whose value is compared"}},
      {head + phi +
           "[[reference]]\nof = \"phi\"\nwhen = {grains.count = 3}\nstate = \"last\"\nvalue = 1\nsource = "
           "\"\"\n",
       {"c.toml:7: when.grains.count: expected a key that [grid] or a [[case]] sets"}},
  };
  for (const auto& [text, messages] : bad) {
    write_text(file("c.toml"), text);
    for (const char* command : {"check c.toml", "plan c.toml -o planned"}) {
      const Outcome o = floc(std::string("campaign ") + command);
      EXPECT_EQ(o.code, 4) << text;
      for (const char* message : messages) EXPECT_THAT(o.err, HasSubstr(message)) << text;
      EXPECT_EQ(o.out, "");
    }
    EXPECT_FALSE(fs::exists(file("planned"))) << text;
  }
  EXPECT_EQ(floc("campaign check absent.toml").code, 4);
  EXPECT_EQ(floc("campaign check .").code, 4);
  EXPECT_THAT(floc("campaign collect . ").err, HasSubstr("this directory contains no campaign"));
  EXPECT_THAT(floc("campaign run small.toml --seed 1 -o r --table moduli").err,
              HasSubstr("expected FILE: COMMAND"));
  EXPECT_FALSE(fs::exists(file("r")));
}

}  // namespace
}  // namespace floc::test
