#include <fmt/format.h>
#include <fnmatch.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "floc/io/csv.h"
#include "support/places.h"
#include "support/run_on_terminal.h"
#include "support/small_run.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class Columns : public SmallRun {
 protected:
  static std::vector<std::string> header(const std::string& text) {
    std::istringstream in(text);
    return CsvTable::parse("stdout", in).columns();
  }
};

TEST_F(Columns, ArePrintedInTheOrderTheyAreNamed) {
  const Outcome o = floc("moduli run/state-0003.h5 --columns B,G,z,phi");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(header(o.out), ElementsAre("B", "G", "z", "phi"));
  EXPECT_THAT(
      header(floc("moduli run/state-0003.h5 --columns 'file,error_B*,C1?'").out),
      ElementsAre("file", "error_B", "error_B_S", "error_B_equilibrium", "error_B_sampling", "C11", "C12"));
  const json row = json::parse(floc("network run/state-0003.h5 --columns z,x0 --format json").out).at(0);
  EXPECT_EQ(row.size(), 2u);
  EXPECT_EQ(row.at("x0"), json::parse(floc("network run/state-0003.h5 --format json").out).at(0).at("x0"));
  EXPECT_EQ(floc("verify run/state-0003.h5 --columns all").out, floc("verify run/state-0003.h5").out);
}

TEST_F(Columns, OfEveryCommandThatPrintsATableCanBeChosen) {
  const std::pair<const char*, const char*> commands[] = {
      {"moduli run/state-0003.h5", "phi"},
      {"modes run/state-0003.h5", "eigenvalue"},
      {"network run/state-0003.h5", "phi"},
      {"structure run/state-0003.h5", "phi"},
      {"compare run/state-0003.h5 run/state-0004.h5", "n_kept"},
      {"compare run run", "identical"},
      {"verify run/state-0003.h5", "force"},
      {"info run/state-0003.h5", "phi"},
      {"scene check small.toml", "group"},
      {"chain --n 3 --R 0.5 --kn 1 --kt 1 --kr 1", "solved"},
      {"fit elastic run", "parameter"},
      {"fit cycle run", "work"},
      {"report run -o r.html", "n_states"},
      {"plot run -o p.svg --show coordination", "picture"},
  };
  for (const auto& [command, column] : commands) {
    const Outcome o = floc(std::string(command) + " --format csv --columns " + column);
    EXPECT_THAT(o.out, StartsWith(std::string(column) + "\n")) << command << ": " << o.err;
  }
}

TEST_F(Columns, UnknownOnesAreRefusedBeforeWorkWithTheNearest) {
  const Outcome o = floc("moduli run/state-0003.h5 --columns B,B_voight");
  EXPECT_EQ(o.code, 4);
  EXPECT_EQ(o.out, "");
  EXPECT_THAT(o.err,
              HasSubstr("--columns: no column of floc moduli is named B_voight; the nearest is B_voigt"));
}

TEST_F(Columns, OfAnotherCommandAreRefusedBeforeWork) {
  // None of these files exists: a command that opened them would name them in its message.
  for (const char* command : {"moduli none.h5",
                              "modes none.h5",
                              "network none.h5",
                              "structure none.h5",
                              "lattice none.h5 --matrix 0.1",
                              "compare none.h5 none.h5",
                              "verify none.h5",
                              "info none.h5",
                              "scene check none.toml",
                              "fit consolidation none.csv",
                              "fit elastic none.csv",
                              "fit preconsolidation none.csv",
                              "fit moduli none.csv",
                              "fit cycle none.csv",
                              "fit strength none.csv",
                              "fit force-distribution none.csv",
                              "fit dynamic-compaction none.csv",
                              "report none -o r.html",
                              "plot none -o p.svg --show coordination",
                              "tradeoff none.toml",
                              "plan none.toml --budget 1h",
                              "campaign check none.toml",
                              "campaign outcome none",
                              "campaign collect none --table means"}) {
    const Outcome o = floc(std::string(command) + " --columns seeds_of_another");
    EXPECT_EQ(o.code, 4) << command;
    EXPECT_EQ(o.out, "") << command;
    EXPECT_THAT(o.err, HasSubstr("seeds_of_another; the nearest is ")) << command;
  }
  EXPECT_THAT(floc("moduli none.h5 --columns B,pore_size").err,
              HasSubstr("--columns: no column of floc moduli is named pore_size"));
}

/// Returns the number of characters in the longest line.
std::size_t widest(const std::string& text) {
  std::istringstream lines(text);
  std::size_t most = 0;
  for (std::string line; std::getline(lines, line);) most = std::max(most, line.size());
  return most;
}

TEST_F(Columns, OnATerminalFitItsWidthAndInAPipeAreAll) {
  for (const char* command : {"moduli", "network", "structure", "verify", "modes"})
    for (const int width : {60, 80, 132}) {
      const Outcome o =
          run_on_terminal(std::string(command) + " run/state-0003.h5 run/state-0004.h5", file(""), width);
      EXPECT_EQ(o.code, 0) << o.err;
      EXPECT_GT(o.out.size(), 50u) << command;
      EXPECT_LE(widest(o.out), static_cast<std::size_t>(width)) << command << "\n" << o.out;
      EXPECT_THAT(o.err, HasSubstr("--columns all")) << command;
    }
  const Outcome wide = run_on_terminal("moduli run/state-0003.h5 --columns all", file(""), 80);
  EXPECT_GT(widest(wide.out), 500u);
  EXPECT_THAT(run_on_terminal("moduli run/state-0003.h5 --columns Z2", file(""), 80).out, HasSubstr("Z2\n"));
  const Outcome piped = floc("moduli run/state-0003.h5 --format table");
  EXPECT_GT(widest(piped.out), 500u);
  EXPECT_GT(header(floc("moduli run/state-0003.h5").out).size(), 60u);
}

/// Returns the columns that `floc help columns` describes for a table. The description of "moduli" includes
/// "moduli --increments".
std::vector<std::string> described(const std::string& table) {
  const Outcome o = run_floc("help columns " + table.substr(0, table.find(" --")) + " --format json");
  EXPECT_EQ(o.code, 0) << o.err;
  std::vector<std::string> names;
  for (const json& row : json::parse(o.out))
    if (row.at("table") == table) names.push_back(row.at("column"));
  return names;
}

TEST_F(Columns, AreAllDescribedAndNothingElseIs) {
  ASSERT_EQ(floc("moduli run/state-0003.h5 --increments i.csv").code, 0);
  ASSERT_EQ(floc("network run/state-0003.h5 --pdf f.csv --particle-stress g.csv --exponents x.csv "
                 "--pressure-pdf pp.csv --like-neighbours ln.csv --clusters cl.csv")
                .code,
            0);
  ASSERT_EQ(floc("structure run/state-0003.h5 --intensity I.csv --pair-correlation gr.csv --gaps z.csv --pores "
                 "p.csv --map m.csv --prediction pr.csv --porosity po.csv --profile sl.csv --profile-axis y")
                .code,
            0);
  ASSERT_EQ(floc("compare run/state-0003.h5 run/state-0004.h5 --displacements u.csv --contacts c.csv").code, 0);
  ASSERT_EQ(floc("export run/state-0003.h5 --grains eg.csv --contacts ec.csv").code, 0);
  ASSERT_EQ(floc("scene check small.toml --sizes sizes.csv").code, 0);
  ASSERT_EQ(floc("info run/state-0003.h5 --sizes state-sizes.csv").code, 0);
  write_text(file("failures.csv"), "sigma1,sigma3\n208,50\n350,100\n640,200\n1235,400\n");
  write_text(file("test.csv"), "p [kPa],e\n1,0.9\n2,0.8\n");
  write_text(file("moduli.csv"), "P,B\n1,5\n2,6\n3,7\n4,8\n");
  const std::pair<const char*, std::string> tables[] = {
      {"moduli", floc("moduli run/state-0003.h5 --strains full --prestress --rolling-stiffness 1").out},
      {"modes", floc("modes run/state-0003.h5").out},
      {"network", floc("network run/state-0003.h5 --with bonds,phases").out},
      {"structure", floc("structure run/state-0003.h5").out},
      {"compare", floc("compare run/state-0003.h5 run/state-0004.h5").out},
      {"compare of two runs", floc("compare run run").out},
      {"verify", floc("verify run/state-0003.h5").out},
      {"info", floc("info run/state-0003.h5").out},
      {"info of tables", floc("info test.csv").out},
      {"chain", floc("chain --n 3 --R 0.5 --kn 1 --kt 1 --kr 1").out},
      {"scene check", floc("scene check small.toml").out},
      {"info --sizes", content_of(file("state-sizes.csv"))},
      {"scene check --sizes", content_of(file("sizes.csv"))},
      {"fit consolidation",
       floc("fit consolidation " + source_directory() + "/data/tables/demo/seed-1 --bootstrap 2").out},
      {"fit compression",
       floc("fit compression " + source_directory() + "/data/tables/demo/seed-1 --law kawakita").out},
      {"fit elastic", floc("fit elastic run").out},
      {"fit preconsolidation", floc("fit preconsolidation " + source_directory() + "/data/tables/reload").out},
      {"fit moduli", floc("fit moduli moduli.csv").out},
      {"fit cycle", floc("fit cycle run").out},
      {"fit strength", floc("fit strength failures.csv").out},
      {"fit force-distribution", floc("fit force-distribution run/state-0003.h5 --draws 2").out},
      {"draw", floc("draw run/state-0003.h5 -o d.svg").out},
      {"plot", floc("plot run -o p.svg --show coordination").out},
      {"report", floc("report run -o r.html").out},
      {"path.csv", content_of(file("run/path.csv"))},
      {"moduli --increments", content_of(file("i.csv"))},
      {"network --pdf", content_of(file("f.csv"))},
      {"network --particle-stress", content_of(file("g.csv"))},
      {"network --exponents", content_of(file("x.csv"))},
      {"network --pressure-pdf", content_of(file("pp.csv"))},
      {"network --like-neighbours", content_of(file("ln.csv"))},
      {"network --clusters", content_of(file("cl.csv"))},
      {"structure --porosity", content_of(file("po.csv"))},
      {"structure --profile", content_of(file("sl.csv"))},
      {"structure --intensity", content_of(file("I.csv"))},
      {"structure --pair-correlation", content_of(file("gr.csv"))},
      {"structure --gaps", content_of(file("z.csv"))},
      {"structure --pores", content_of(file("p.csv"))},
      {"structure --map", content_of(file("m.csv"))},
      {"structure --prediction", content_of(file("pr.csv"))},
      {"compare --displacements", content_of(file("u.csv"))},
      {"compare --contacts", content_of(file("c.csv"))},
      {"export --grains", content_of(file("eg.csv"))},
      {"export --contacts", content_of(file("ec.csv"))},
  };
  // Columns that this test does not produce: they need another dimension, other options or other boundaries.
  const std::set<std::string> elsewhere = {"isotropic_rolling?",
                                           "deviatoric_rolling?",
                                           "isotropic_twisting",
                                           "deviatoric_twisting",
                                           "twisting_moment",
                                           "bridge_volume",
                                           "export --contacts ktw",
                                           "tensile_strength",
                                           "bonded",
                                           "shear_strength",
                                           "rolling_strength",
                                           "twisting_strength",
                                           "rolling_moment?",
                                           "grain",
                                           "voronoi_volume",
                                           "radius",
                                           "L3",
                                           "z",
                                           "z_low",
                                           "strain?",
                                           "n_wall_contacts",
                                           "z_wall",
                                           "kinetic_over_elastic",
                                           "path.csv n_mechanisms",
                                           "p_wall_?",
                                           "p_friction_?",
                                           "z_pairs",
                                           "n_sweeps",
                                           "n_unfinished",
                                           "deepest_overlap",
                                           "path.csv force_freedom",
                                           "verify cone",
                                           "verify gap",
                                           "verify power",
                                           "verify step",
                                           "verify overlap",
                                           "inertial_number",
                                           "step_residual",
                                           "export --grains shape",
                                           "scale",
                                           "angle",
                                           "qx",
                                           "qy",
                                           "qz",
                                           "qw",
                                           "point?",
                                           "normal?",
                                           "export --contacts gap",
                                           "export --contacts kind"};
  for (const auto& [table, text] : tables) {
    const std::vector<std::string> names = described(table);
    const auto columns = header(text);
    const auto stands_for = [](const std::string& pattern, const std::string& name) {
      return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
    };
    for (const std::string& column : columns)
      EXPECT_TRUE(std::ranges::any_of(names, [&](const auto& name) { return stands_for(name, column); }))
          << table << " prints " << column << ", which is not described";
    for (const std::string& name : names)
      EXPECT_TRUE(elsewhere.contains(name) || elsewhere.contains(std::string(table) + " " + name) ||
                  std::ranges::any_of(columns, [&](const auto& column) { return stands_for(name, column); }))
          << table << " is said to have " << name;
  }
}

TEST_F(Columns, HelpComesFromTheReferenceThatIsShipped) {
  const std::string reference = content_of(source_directory() + "/docs/columns.md");
  int n = 0;
  for (const json& row : json::parse(floc("help columns --format json").out)) {
    ++n;
    const std::string unit = row.at("unit").is_null() ? "" : row.at("unit").get<std::string>();
    EXPECT_THAT(reference,
                HasSubstr(fmt::format("| {} | {}{}| {} |", row.at("column").get<std::string>(), unit,
                                      unit.empty() ? "" : " ", row.at("meaning").get<std::string>())));
  }
  EXPECT_GT(n, 300);
  EXPECT_THAT(floc("help columns fit elastic --format csv").out, HasSubstr("fit elastic,P_low,stress"));
  const Outcome unknown = floc("help columns moduly");
  EXPECT_EQ(unknown.code, 4);
  EXPECT_THAT(unknown.err, HasSubstr("the nearest is \"moduli\""));
  EXPECT_EQ(floc("help moduli").out, floc("moduli --help").out);
}

}  // namespace
}  // namespace floc::test
