#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/run_program.h"

namespace floc::test {
namespace {

using testing::HasSubstr;

struct BadTable {
  const char* what;
  std::string text;
  int code;
  const char* message;
};

std::string flat_table() {
  std::string text = "branch,P_star,phi\n";
  for (int k = 0; k < 12; ++k) text += fmt::format("load,{},{}\n", 0.01 * (k + 1), k % 2 == 0 ? 0.5 : 0.50001);
  return text;
}

std::string elastic_table() {
  std::string text = "branch,P_star,phi\n";
  for (int k = 0; k < 12; ++k) {
    const double P = 0.01 * std::pow(10.0, k / 8.0);
    text += fmt::format("load,{},{}\n", P, 0.5 * (1 + P / 1000));
  }
  return text;
}

/// Table with a plateau, followed by only two pressures at which the density grows.
std::string too_short_table() {
  std::string text = "branch,P_star,phi\n";
  for (int k = 0; k < 8; ++k) text += fmt::format("load,{},0.5\n", 0.01 * std::pow(10.0, k / 8.0));
  return text + "load,0.1,0.55\nload,0.2,0.6\n";
}

TEST(FitConsolidation, EveryBadTableIsRefusedByNameAndCode) {
  const BadTable tables[] = {
      {"pressure that falls within a branch",
       "branch,P_star,phi\nload,0.1,0.5\nload,0.2,0.52\nload,0.15,0.53\n", 4,
       "stdin:4: P_star = 0.15: expected a pressure that grows"},
      {"pressure that grows while unloading", "branch,P_star,phi\nload,1,0.6\nunload,0.5,0.6\nunload,0.7,0.6\n",
       4, "stdin:4: P_star = 0.7: expected a pressure that falls"},
      {"repeated pressure", "P_star,phi\n0.1,0.5\n0.1,0.5\n", 3, "1 pressures"},
      {"negative pressure", "P_star,phi\n-0.1,0.5\n", 4, "stdin:2: P_star = -0.1: expected a pressure >= 0"},
      {"negative density", "P_star,phi\n0.1,-0.5\n", 4,
       "stdin:2: phi = -0.5: expected a positive solid fraction"},
      {"negative void ratio", "P_star,void_ratio\n0.1,-0.5\n", 4, "stdin:2: void_ratio = -0.5"},
      {"missing pressure", "load,phi\n0.1,0.5\n", 4, "has no column \"P_star\""},
      {"missing density", "P_star,density\n0.1,0.5\n", 4, "has no column \"phi\""},
      {"NaN", "P_star,phi\n0.1,0.5\n0.2,nan\n", 4, "stdin:3: phi = \"nan\", expected a finite number"},
      {"empty cell", "P_star,phi\n0.1,0.5\n0.2,\n", 4, "stdin:3"},
      {"ragged line", "P_star,phi\n0.1,0.5\n0.2\n", 4, "stdin:3"},
      {"nothing", "", 4, "stdin"},
      {"header alone", "P_star,phi\n", 3, "0 pressures"},
      {"one row", "P_star,phi\n0.1,0.5\n", 3, "1 pressures"},
      {"regime I alone", flat_table(), 3, "all pressures lie in regime I"},
      {"elastic", elastic_table(), 3, "all pressures lie in regime I"},
  };
  for (const BadTable& table : tables) {
    const Outcome o = run_floc("fit consolidation - --format json", ".", table.text);
    EXPECT_EQ(o.code, table.code) << table.what << ": " << o.err;
    EXPECT_THAT(o.err, HasSubstr(table.message)) << table.what;
  }
}

TEST(FitConsolidation, TwoRowsBeyondThePlateauAreTooFewForTheFullLaw) {
  const Outcome o = run_floc("fit consolidation - --law full", ".", too_short_table());
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err, HasSubstr("there are 3 pressures in the window, but a fit of the full law needs 5"));
}

TEST(FitConsolidation, BadMapsAreNamed) {
  const char* table = "p,phi\n0.1,0.5\n";
  const Outcome unknown = run_floc("fit consolidation - --columns pressure=p", ".", table);
  EXPECT_EQ(unknown.code, 4);
  EXPECT_THAT(unknown.err, HasSubstr("expected NAME=COLUMN, where NAME is one of P_star"));
  const Outcome absent = run_floc("fit consolidation - --columns P_star=q", ".", table);
  EXPECT_EQ(absent.code, 4);
  EXPECT_THAT(absent.err, HasSubstr("has no column \"q\"; its columns are p, phi"));
}

TEST(FitElastic, BadTablesAreRefused) {
  EXPECT_EQ(run_floc("fit elastic -", ".", "P,phi\n1,0.5\n2,0.6\n").code, 3);
  EXPECT_EQ(run_floc("fit elastic -", ".", "P,phi\n1,0.5\n0.5,0.4\n").code, 3);
  EXPECT_EQ(run_floc("fit elastic -", ".", "P,phi\n1,0.5\n0.5,-0.4\n").code, 4);
  const Outcome percent = run_floc("fit elastic -", ".", "P,phi\n3,58.9\n2,58.8\n1,58.7\n");
  EXPECT_EQ(percent.code, 4);
  EXPECT_THAT(percent.err,
              HasSubstr("stdin:2: phi = 58.9: expected a solid fraction of at most 1; is it in percent"));
  EXPECT_EQ(run_floc("fit elastic - --state absent.h5", ".", "P,phi\n1,.5\n.6,.4\n.3,.3\n").code, 4);
}

TEST(FitDynamicCompaction, BadTablesAreRefused) {
  EXPECT_EQ(run_floc("fit dynamic-compaction -", ".", "e,p,sc\n1,1,1\n").code, 4);
  const Outcome zero = run_floc("fit dynamic-compaction -", ".", "e,p,sc,se\n1,1,0,1\n");
  EXPECT_EQ(zero.code, 4);
  EXPECT_THAT(zero.err, HasSubstr("stdin:2: sc = 0: expected a positive number"));
  EXPECT_EQ(run_floc("fit dynamic-compaction -", ".", "e,p,sc,se\n1,1,1,1\n").code, 3);
  EXPECT_EQ(run_floc("fit dynamic-compaction - --plateau sc", ".", "e,p,sc,se\n1,1,1,1\n").code, 2);
}

TEST(FitForceDistribution, BadTablesAreRefused) {
  EXPECT_EQ(run_floc("fit force-distribution -", ".", "force\n1\n").code, 4);
  EXPECT_EQ(run_floc("fit force-distribution -", ".", "normal_force\none\n").code, 4);
  EXPECT_EQ(run_floc("fit force-distribution -", ".", "normal_force\n1\n").code, 3);
  EXPECT_EQ(run_floc("fit force-distribution absent.h5").code, 4);
}

}  // namespace
}  // namespace floc::test
