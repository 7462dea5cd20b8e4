#include "floc/campaign/campaign_tables.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "floc/campaign/campaign_cases.h"

namespace floc {
namespace {

/// Rows of a table of fits, made from the table that floc fit prints for one case.
class FitsOfACase {
 public:
  explicit FitsOfACase(const std::string& printed) {
    Campaign campaign;
    set_cases({}, {{"x", {{"run.seed", "7", ""}}, ""}}, "", campaign);
    std::istringstream in(printed);
    table_ = empty_fits(campaign);
    add_fit(campaign, campaign.cases.at(0), {"elastic", {}}, CsvTable::parse("fit.csv", in), table_);
  }
  /// Returns the row of a parameter for all samples, by the names of the columns.
  std::map<std::string, TableValue> row(const std::string& sample, const std::string& parameter) const {
    std::map<std::string, TableValue> found;
    for (const auto& cells : table_.rows) {
      std::map<std::string, TableValue> row;
      for (std::size_t c = 0; c < cells.size(); ++c) row[table_.columns[c]] = cells[c];
      if (row["sample"] == TableValue(sample) && row["parameter"] == TableValue(parameter)) found = row;
    }
    return found;
  }

 private:
  Table table_;
};

void expect_mean(const FitsOfACase& fits, const std::string& parameter, double value, std::int64_t n) {
  auto mean = fits.row("mean", parameter);
  EXPECT_EQ(mean["value"], TableValue(value)) << parameter;
  EXPECT_EQ(mean["n"], TableValue(n)) << parameter;
}

TEST(TableOfFits, MeansLeaveOutValuesThatTheDataDoNotIdentify) {
  const FitsOfACase fits(
      "sample,parameter,value,stderr,low95,high95,identified\n"
      "x/seed-1/path.csv,B,100,1,98,102,true\nx/seed-2/path.csv,B,104,1,102,106,true\n"
      "x/seed-3/path.csv,B,2e16,3e16,,,false\n");
  expect_mean(fits, "B", 102.0, 2);
}

TEST(TableOfFits, EachBranchOfTheSamplesHasItsOwnMean) {
  const FitsOfACase fits(
      "sample,parameter,value,stderr,low95,high95,identified\n"
      "x/seed-1/path.csv,B,100,1,98,102,true\nx/seed-1/path.csv,B,200,1,198,202,true\n"
      "x/seed-2/path.csv,B,104,1,102,106,true\nx/seed-2/path.csv,B,206,1,204,208,true\n");
  expect_mean(fits, "B", 102.0, 2);
  expect_mean(fits, "B_2", 203.0, 2);
}

TEST(TableOfFits, PooledFitsCountAllSamples) {
  const FitsOfACase fits(
      "sample,parameter,value,stderr,low95,high95,identified\n"
      "x/seed-1/path.csv,alpha,,,0.5,,false\nx/seed-2/path.csv,alpha,1.1,0.1,0.9,1.3,true\n"
      "x/seed-3/path.csv,alpha,,,0.4,,false\npooled,alpha,1,0.1,0.8,1.2,true\n");
  EXPECT_EQ(fits.row("pooled", "alpha")["n"], TableValue(std::int64_t{3}));
  EXPECT_TRUE(fits.row("mean", "alpha").empty());
}

}  // namespace
}  // namespace floc
