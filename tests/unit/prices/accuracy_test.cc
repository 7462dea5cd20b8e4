#include "floc/prices/accuracy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "support/message_of.h"

namespace floc {
namespace {

using testing::HasSubstr;

const std::string kHeader =
    "knob,value,observable,error_before_high,error_after_high,mean_difference,mean_error95,cost_ratio,"
    "tolerance,"
    "time_step,"
    "finish,patience,kappa\n";

/// Price table with the reference (strict), three cheaper settings of increasing cost (together, tolerance, scene), and
/// one setting of a parameter that no scene can set (samples).
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

/// The table with additional rows in which parameters of the cell are varied. These settings are cheap, but must not be
/// chosen, because settings of the cell are never chosen.
const std::string kTableWithCells = kTable +
                                    "cell_mass,10 times,phi,1e-3,1e-4,-0.01,0.001,0.05,1e-5,0.28,auto,1,1e5\n"
                                    "cell_mass,2 times,phi,1e-4,2e-4,0,0.001,0.05,1e-5,0.28,auto,1,1e5\n"
                                    "cell_mass,0.1 times,phi,1e-6,1e-6,0,0.001,0.05,1e-5,0.28,auto,1,1e5\n"
                                    "strain_rate_cap,5 times,phi,1e-2,1e-3,0,0.001,0.05,1e-5,0.28,auto,1,1e5\n";

PriceTable shipped_like(const std::string& csv) {
  PriceTable table = read_price_table(csv, "table");
  table.is_shipped = true;
  return table;
}

AccuracyChoice choice(const WantedAccuracy& wanted) {
  return choose_accuracy(shipped_like(kTable), wanted);
}

AccuracyChoice choice_with(const std::vector<CellFactors>& cells, double phi) {
  return choose_accuracy(shipped_like(kTableWithCells), {{"phi", phi}}, cells);
}

TEST(Accuracy, TheCheapestSettingWhoseErrorIsBelowIsTaken) {
  EXPECT_EQ(choice({{"phi", 5e-2}}).name, "together coarse");
  EXPECT_EQ(choice({{"phi", 4.9e-2}}).name, "tolerance 1e-4");
  const NumericalSettings coarse{1e-2, 0.36, Finish::statics, 0.2};
  EXPECT_EQ(choice({{"phi", 5e-2}}).settings, coarse);
}

TEST(Accuracy, ADifferenceOfMeansBeyondItsSamplingErrorCountsToo) {
  // The means differ by 0.05, with a sampling error of 0.03. The difference exceeds the sampling error by 0.02. This
  // counts as an error, although single states are accurate to 1e-5.
  EXPECT_EQ(choice({{"phi", 2.1e-2}}).name, "tolerance 1e-4");
  EXPECT_EQ(choice({{"phi", 1.9e-2}}).name, "scene as it is");
}

/// Sweeps that end early compact large packings by more than the small samples of a table resolve. The settings
/// "together" of rigid grains have such sweeps, too; those of elastic grains have no sweeps.
TEST(Accuracy, LooseSweepsAreNoChoice) {
  const auto table = [](const std::string& kind) {
    std::string csv = kHeader.substr(0, kHeader.size() - 1) + ",kind\n";
    for (const std::string row :
         {"strict,all,phi,0,0,0,0,1,1e-8,0.1,auto,2,", "scene,as it is,phi,2e-6,,0,0.02,0.3,1e-5,0.28,auto,1,",
          "sweep_tolerance,1e-01,phi,1e-6,,0,0.02,0.01,1e-5,0.28,auto,1,",
          "sweep_tolerance,1e-02,phi,1e-6,,0,0.02,0.02,1e-5,0.28,auto,1,",
          "together,coarse,phi,1e-6,,0,0.02,0.03,1e-5,0.28,auto,1,",
          "together,medium,phi,1e-6,,0,0.02,0.04,1e-5,0.28,auto,1,",
          "together,careful,phi,1e-6,,0,0.02,0.05,1e-5,0.28,auto,1,",
          "sweep_tolerance,1e-04,phi,1e-6,,0,0.02,0.06,1e-5,0.28,auto,1,"})
      csv += row + "1e5," + kind + "\n";
    return read_price_table(csv, "table");
  };
  const PriceTable rigid = table("rigid-disks"), elastic = table("disks-cohesive");
  std::vector<std::string> loose;
  for (const PricedSettings& settings : settable_prices(rigid))
    if (settings.has_loose_sweeps()) loose.push_back(settings.name());
  EXPECT_THAT(loose, testing::ElementsAre("sweep_tolerance 1e-01", "sweep_tolerance 1e-02", "together coarse",
                                          "together medium"));
  EXPECT_EQ(choose_accuracy(rigid, {{"phi", 0.1}}).name, "together careful");
  EXPECT_EQ(choose_accuracy(elastic, {{"phi", 0.1}}).name, "together coarse");
}

TEST(Accuracy, SoftSpringsAreNoChoiceAndTheirErrorIsAllThatTheSamplesDoNotExclude) {
  std::string soft;
  for (const char* row : {"strict,all,phi,0,0,0,0,1,1e-8,0.1,auto,2,1e5,1,1\n",
                          "scene,as it is,phi,2e-6,,0.001,0.02,0.3,1e-5,0.28,auto,1,1e5,1,1\n",
                          "softening,10,phi,,,0.003,0.004,0.1,1e-5,0.28,auto,1,1e5,10,10\n",
                          "assembly_softening,100,phi,,,0.004,0.003,0.2,1e-5,0.28,auto,1,1e5,,100\n"})
    soft += row;
  const PriceTable table =
      shipped_like(kHeader.substr(0, kHeader.size() - 1) + ",softening,assembly_softening\n" + soft);
  EXPECT_EQ(choose_accuracy(table, {{"phi", 0.1}}).name, "scene as it is");
  const std::vector<PricedSettings> prices = settable_prices(table);
  ASSERT_EQ(prices.size(), 4u);
  EXPECT_EQ(prices[0].settings.softening, (Softening{10.0, 10.0}));
  EXPECT_EQ(prices[1].settings.softening, (Softening{100.0, 1.0}));
  EXPECT_DOUBLE_EQ(settings_error(prices[0], "phi"), 0.005);
  EXPECT_DOUBLE_EQ(settings_error(prices[1], "phi"), 0.005);
  EXPECT_DOUBLE_EQ(settings_error(prices[2], "phi"), 2e-6);
}

TEST(Accuracy, EqualMassesAreNoChoiceAndTheirErrorIsAllThatTheSamplesDoNotExclude) {
  const PriceTable table = shipped_like(kHeader.substr(0, kHeader.size() - 1) + ",masses\n" +
                                        "strict,all,phi,0,0,0,0,1,1e-8,0.1,auto,2,1e5,own\n"
                                        "scene,as it is,phi,2e-6,,0.001,0.02,0.3,1e-5,0.28,auto,1,1e5,own\n"
                                        "masses,equal,phi,,,0.003,0.004,0.1,1e-5,0.28,auto,1,1e5,equal\n");
  EXPECT_EQ(choose_accuracy(table, {{"phi", 0.1}}).name, "scene as it is");
  const std::vector<PricedSettings> prices = settable_prices(table);
  ASSERT_EQ(prices.size(), 3u);
  EXPECT_TRUE(prices[0].settings.equal_masses);
  EXPECT_DOUBLE_EQ(settings_error(prices[0], "phi"), 0.005);
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
  // The reference has no error relative to itself, by definition. This does not guarantee any accuracy.
  EXPECT_EQ(choice({{"phi", 2e-6}}).name, "scene as it is");
  EXPECT_THAT(choice({{"phi", 1.9e-6}}).failure_reason, HasSubstr("expected at least 2e-06"));
}

TEST(Accuracy, TheCellAddsTheErrorOfTheNearestFactorMeasuredBeyondItsOwn) {
  // A scene with the default cell gets no additional error. Rows about the cell are never chosen, however cheap
  // they are.
  EXPECT_EQ(choice_with({{}}, 5e-2).name, "together coarse");
  EXPECT_EQ(choice_with({{1.5, 1.0}}, 5.02e-2).name, "together coarse");
  EXPECT_NE(choice_with({{1.5, 1.0}}, 5.01e-2).name, "together coarse");
  // A cell of 10 times the mass changes means by 0.01, which exceeds the sampling error of 0.001 by 0.009. This
  // difference is added to the error. A cell of 0.1 times the mass adds an error of 1e-6.
  EXPECT_EQ(choice_with({{3.0, 1.0}}, 5.91e-2).name, "together coarse");
  EXPECT_NE(choice_with({{3.0, 1.0}}, 5.89e-2).name, "together coarse");
  EXPECT_EQ(choice_with({{0.1, 1.0}}, 5.0001e-2 + 1e-9).name, "together coarse");
  // The errors due to the two parameters of the cell are added, even if these parameters differ from their defaults in
  // different parts of the run. The same change in two parts counts once.
  EXPECT_EQ(choice_with({{2.0, 1.0}, {1.0, 5.0}, {2.0, 1.0}}, 6.03e-2).name, "together coarse");
  EXPECT_NE(choice_with({{2.0, 1.0}, {1.0, 5.0}, {2.0, 1.0}}, 6.01e-2).name, "together coarse");
}

TEST(Accuracy, WhatTheCellAddsIsSaidAndCountsForTheLeastError) {
  EXPECT_THAT(
      choice_with({{2.0, 1.0}}, 6e-2).reason,
      HasSubstr(". The total also includes the errors measured with cell_mass at 2 times its default value: "
                "phi 2.0e-04 in 95 % of the states"));
  EXPECT_THAT(
      choice_with({{2.0, 1.0}}, 2.01e-4).failure_reason,
      HasSubstr(
          "expected at least 0.00021, which is the smallest error in the table shipped with floc for this "
          "quantity for the mass and the strain rate of the cell in the scene"));
}

TEST(Accuracy, TheTableSpeaksForCellsBetweenThoseMeasured) {
  const auto table = read_price_table(kTableWithCells, "table");
  EXPECT_EQ(problem_of_factors(table, {1.0, 1.0}), "");
  EXPECT_EQ(problem_of_factors(table, {10.0, 5.0}), "");
  EXPECT_EQ(problem_of_factors(table, {0.01 / 0.1, 1.0}), "");
  EXPECT_EQ(
      problem_of_factors(table, {10.1, 1.0}),
      "cell_mass is 10.1 times its default value on load paths, but the table table covers 0.1 to 10 times");
  EXPECT_THAT(problem_of_factors(table, {0.09, 1.0}), HasSubstr("cell_mass is 0.09 times"));
  EXPECT_THAT(problem_of_factors(table, {1.0, 0.9}), HasSubstr("strain_rate_cap is 0.9 times"))
      << "slower cells were not measured";
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
      "Measured errors: phi 5.0e-02 in 95 % of the states, +3.0e-02 +- 2.0e-02 in the means over samples of "
      "the states after a collapse");
}

TEST(Accuracy, TheTableSpeaksForGrainsAboutAsStiff) {
  const auto table = read_price_table(kTable, "table");
  EXPECT_TRUE(covers_stiffness(table, 1e4));
  EXPECT_TRUE(covers_stiffness(table, 1e6));
  EXPECT_FALSE(covers_stiffness(table, 9e3));
  EXPECT_FALSE(covers_stiffness(table, 1.1e6));
}

TEST(Accuracy, ATableThatIsNoneIsRefusedByLine) {
  const auto fails = [](const std::string& csv, const std::string& message) {
    try {
      (void)read_price_table(csv, "t.csv");
      ADD_FAILURE() << csv;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
  };
  fails("knob,value\nscene,1\n", "t.csv: column observable is missing");
  fails(kHeader + "scene,x,phi,much,,,,0.3,1e-5,0.28,auto,1,1e5\n",
        "t.csv:2: the value of column error_before_high is much: expected a number");
}

TEST(PriceTable, IsOfTheKindThatItsRowsName) {
  const std::string header = kHeader.substr(0, kHeader.size() - 1) + ",kind,n_grains\n";
  const std::string row = "scene,x,phi,,,,,0.3,1e-5,0.28,auto,1,1e5,";
  EXPECT_EQ(read_price_table(kTable, "t.csv").kind, "") << "older tables do not say it";
  const PriceTable beads = read_price_table(header + row + "beads-hertz,200\n", "t.csv");
  EXPECT_EQ(beads.kind, "beads-hertz");
  EXPECT_EQ(beads.rows[0].n_grains, 200);
  EXPECT_TRUE(std::isnan(beads.rows[0].core_seconds)) << "a column that is not there";
  for (const auto& [rows, message] :
       {std::pair(row + "beads-hertz,200\n" + row + "disks-cohesive,200\n",
                  "t.csv:3: the value of column kind is disks-cohesive: expected beads-hertz"),
        std::pair(row + "beads-hertz,2.5\n", "t.csv:2: the value of column n_grains is 2.5: expected a whole")})
    try {
      (void)read_price_table(header + rows, "t.csv");
      ADD_FAILURE() << rows;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
}

TEST(PriceTable, OfAnotherVersionIsRefused) {
  const auto refusal = [](const std::string& version) {
    const std::string csv = kHeader.substr(0, kHeader.size() - 1) +
                            ",version\nscene,x,phi,,,,,0.3,1e-5,0.28,auto,1,1e5," + version + "\n";
    return test::message_of([&] { (void)read_price_table(csv, "t.csv"); });
  };
  EXPECT_EQ(refusal("1"), "");
  EXPECT_EQ(refusal(""), "");
  for (const char* other : {"0", "2", "1.5", "-1"})
    EXPECT_THAT(refusal(other), HasSubstr(std::string("t.csv:2: the value of column version is ") + other +
                                          ": expected 1, the version"));
}

TEST(PriceTable, IsShippedForEachKindThatIsNamed) {
  const std::vector<std::string> kinds = priced_kinds();
  EXPECT_THAT(kinds, testing::Contains("disks-cohesive"));
  for (const std::string& kind : kinds) {
    const std::optional<PriceTable> table = shipped_prices(kind);
    ASSERT_TRUE(table) << kind;
    EXPECT_EQ(table->kind, kind);
    EXPECT_FALSE(table->rows.empty()) << kind;
  }
  EXPECT_FALSE(shipped_prices("cubes-magnetic"));
}

TEST(Accuracy, TheShippedTableHasTheReferenceAndTheSceneItself) {
  const std::optional<PriceTable> table = shipped_prices("disks-cohesive");
  ASSERT_TRUE(table);
  for (const char* parameter : {"strict", "scene", "together"})
    EXPECT_TRUE(std::any_of(table->rows.begin(), table->rows.end(), [&](const auto& row) {
      return row.parameter == parameter;
    })) << parameter;
}

TEST(Accuracy, SettingsWithTooLargeAToleranceAreLeftOut) {
  const PriceTable table = shipped_like(kTable);
  EXPECT_EQ(choose_accuracy(table, {{"phi", 5e-2}}, {}, 2e-2).name, "together coarse");
  EXPECT_EQ(choose_accuracy(table, {{"phi", 5e-2}}, {}, 1e-2).name, "tolerance 1e-4");
  EXPECT_EQ(choose_accuracy(table, {{"phi", 5e-2}}, {}, 1e-4).name, "scene as it is");
}

TEST(Accuracy, NumbersOfMessagesAreRoundedUpwards) {
  EXPECT_EQ(rounded_up(0.00551), "0.0056");
  EXPECT_EQ(rounded_up(0.0055), "0.0055");
  EXPECT_EQ(rounded_up(9.91e-7), "1e-06");
  EXPECT_EQ(rounded_up(1.0001, 3), "1.01");
  for (double x = 1e-8; x < 1e3; x *= 1.37)
    for (const int digits : {2, 3}) EXPECT_GE(std::stod(rounded_up(x, digits)), x * (1.0 - 1e-11)) << x;
}

TEST(PriceTable, RefusesNegativeErrorsAndTablesWithoutTheColumnOfAKnob) {
  const auto refusal = [](const std::string& csv) -> std::string {
    return test::message_of([&] { (void)read_price_table(csv, "prices.csv"); });
  };
  EXPECT_EQ(refusal(kTable), "");
  EXPECT_THAT(refusal(kHeader), HasSubstr("prices.csv: the table has no rows"));
  EXPECT_THAT(refusal(kTable + "strict,all,phi,0,0,0,0,1,1e-8,0.1,auto,2,1e5\n"),
              HasSubstr("a row above has the same knob, value and observable (strict, all, phi)"));
  const std::string header =
      kHeader.substr(0, kHeader.size() - 1) + ",core_seconds,softening,assembly_softening\n";
  const std::string cells = "strict,all,phi,0,0,0,0,1,1e-8,0.1,auto,2,1e5,1,1,1\n";
  EXPECT_EQ(refusal(header + cells), "");
  const std::pair<int, std::string> wrong[] = {
      {7, "cost_ratio"}, {8, "tolerance"},     {9, "time_step"},  {10, "finish"},
      {11, "patience"},  {13, "core_seconds"}, {14, "softening"}, {15, "assembly_softening"}};
  for (const auto& [column, name] : wrong)
    for (const std::string value : {"-1", "0"}) {
      std::vector<std::string> row;
      std::istringstream text(cells.substr(0, cells.size() - 1));
      for (std::string cell; std::getline(text, cell, ',');) row.push_back(cell);
      row[column] = value;
      EXPECT_THAT(refusal(header + fmt::format("{}\n", fmt::join(row, ","))),
                  HasSubstr("prices.csv:2: the value of column " + name + " is " + value + ": expected "));
    }
  EXPECT_THAT(refusal(kHeader + "strict,all,phi,-1,0,0,0,1,1e-8,0.1,auto,2,1e5\n"),
              HasSubstr("the value of column error_before_high is -1: expected a number >= 0"));
  EXPECT_THAT(refusal(kHeader.substr(0, kHeader.size() - 1) + ",masses\n" +
                      "strict,all,phi,0,0,0,0,1,1e-8,0.1,auto,2,1e5,heavy\n"),
              HasSubstr("prices.csv:2: the value of column masses is heavy: expected own or equal"));
  for (const std::string knob : {"softening", "assembly_softening", "masses"})
    EXPECT_THAT(refusal(kTable + knob + ",10,phi,0,0,0,0,1,1e-8,0.1,auto,2,1e5\n"),
                HasSubstr("this row is of the knob " + knob + ", but the column " + knob + " is missing"));
}

}  // namespace
}  // namespace floc
