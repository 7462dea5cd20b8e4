#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_arguments.h"

/// Tests that every fit of a load path reads tables with other quantities than phi and void_ratio, and with names and
/// units that laboratories use.
namespace floc::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kFits[] = {"consolidation", "preconsolidation", "elastic", "cycle"};
constexpr double kInitial = 0.95;  // void ratio before the test

/// Pressures and void ratios of a path with a bend, an unloading and a reloading.
std::vector<std::pair<double, double>> path() {
  std::vector<std::pair<double, double>> rows;
  double largest = 0.0;
  for (const double P :
       {10.0, 20.0, 40.0, 80.0, 160.0, 320.0, 160.0, 80.0, 40.0, 80.0, 160.0, 320.0, 640.0, 1280.0}) {
    largest = std::max(largest, P);
    // Without scatter of the points, the residuals of the fits would be mere rounding errors. The first row gets no
    // scatter, because its exact void ratio is needed to compute some columns.
    const double scatter = 4e-4 * std::sin(7.0 * static_cast<double>(rows.size()));
    rows.emplace_back(P, 0.9 - 0.1 * std::log(largest / 10.0) + 0.02 * std::log(largest / P) + scatter);
  }
  return rows;
}

/// Column of a table from which the void ratio can be computed.
struct Column {
  const char* header;
  std::function<double(double e)> value;
  std::vector<std::string> options = {};
};

std::vector<Column> columns() {
  const auto phi = [](double e) { return 1.0 / (1.0 + e); };
  const auto strain = [](double e) { return 1.0 - (1.0 + e) / (1.0 + kInitial); };
  return {{"void_ratio", [](double e) { return e; }},
          {"e", [](double e) { return e; }},
          {"e [%]", [](double e) { return 100.0 * e; }},
          {"Porenzahl", [](double e) { return e; }},
          {"Void ratio (e)", [](double e) { return e; }},
          {"weird", [](double e) { return e; }, {"--columns", "void_ratio=weird"}},
          {"weird", [](double e) { return 100.0 * e; }, {"--columns", "void_ratio=weird [%]"}},
          {"phi", phi},
          {"relative density, %", [=](double e) { return 100.0 * phi(e); }},
          {"porosity", [=](double e) { return 1.0 - phi(e); }},
          {"Porosität (%)", [=](double e) { return 100.0 * (1.0 - phi(e)); }},
          {"specific volume", [](double e) { return 1.0 + e; }},
          {"dry density [g/cm3]",
           [=](double e) { return 2.65 * phi(e); },
           {"--columns", "particle_density=2650 [kg/m3]"}},
          {"rho_d (g/cm³)", [=](double e) { return 2.65 * phi(e); }, {"--columns", "particle_density=2.65"}},
          {"tablet density", [=](double e) { return 1.5 * phi(e); }, {"--columns", "particle_density=1.5"}},
          {"axial strain", strain, {"--columns", "initial_void_ratio=0.95"}},
          {"axial strain [%]",
           [=](double e) { return 100.0 * strain(e); },
           {"--columns", "initial_void_ratio=0.95"}},
          {"eps", [=](double e) { return -strain(e); }, {"--columns", "initial_void_ratio=0.95"}},
          {"H [mm]",
           [](double e) { return 20.0 * (1.0 + e) / (1.0 + kInitial); },
           {"--columns", "initial_void_ratio=0.95,initial_height=2 [cm]"}},
          {"Wysokość", [](double e) { return 8.0 * (1.0 + e); }, {"--columns", "solid_height=8"}},
          {"thickness", [](double e) { return 3.0 * (1.0 + e); }, {"--columns", "initial_void_ratio=0.9"}}};
}

Outcome fit(const std::string& which, const std::string& table, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"fit", which, "-", "--format", "json"});
  return floc_arguments(more, table);
}

std::string table_of(const std::string& pressure, double unit, const Column& column) {
  std::string table = fmt::format("{};\"{}\"\n", pressure, column.header);
  for (const auto& [P, e] : path()) table += fmt::format("{};{}\n", P * unit, column.value(e));
  return table;
}

/// Returns whether two printed fits contain the same numbers, up to rounding.
bool agree(const json& a, const json& b) {
  if (a.is_number() && b.is_number())
    return std::abs(a.get<double>() - b.get<double>()) <= 1e-6 * std::max(1.0, std::abs(a.get<double>()));
  if (a.is_string()) return b.is_string();  // texts may differ, since warnings contain numbers
  if (a.size() != b.size()) return false;
  for (auto x = a.begin(), y = b.begin(); x != a.end(); ++x, ++y)
    if (a.is_structured() && !agree(*x, *y)) return false;
  return a.is_structured() || a == b;
}

TEST(MeasuredTables, GiveTheSameFitsWhicheverQuantityStandsForTheSolidFraction) {
  int n = 0;
  for (const char* which : kFits) {
    const json expected = json::parse(fit(which, table_of("P_star", 1.0, columns()[0])).out);
    ASSERT_FALSE(expected.empty());
    for (const Column& column : columns()) {
      SCOPED_TRACE(fmt::format("{}: {}", which, column.header));
      const Outcome o = fit(which, table_of("P_star", 1.0, column), column.options);
      ASSERT_FALSE(o.out.empty()) << o.err;
      EXPECT_TRUE(agree(json::parse(o.out), expected)) << o.out;
      ++n;
    }
  }
  fmt::print("{} fits\n", n);
}

TEST(MeasuredTables, HaveUsualNamesAndUnitsOfThePressure) {
  const json expected = json::parse(fit("cycle", table_of("P_star [kPa]", 1.0, columns()[0])).out);
  for (const char* header :
       {"sigma'v [kPa]", "σ′v (kPa)", "p' in kPa", "p_kPa", "Effective vertical stress, kPa", "Spannung [kPa]",
        "contrainte verticale effective (kPa)", "Naprężenie [kPa]", "Pressure kPa", "sigma_v'/kPa",
        "Compaction pressure (kPa)", "P (kN/m²)"}) {
    const Outcome o = fit("cycle", table_of(header, 1.0, columns()[0]));
    ASSERT_EQ(o.code, 0) << header << ": " << o.err;
    EXPECT_TRUE(agree(json::parse(o.out), expected)) << header << o.out;
    EXPECT_THAT(o.err, HasSubstr("read 14 rows: pressure in k")) << header;
  }
  const Outcome two = fit("cycle", "sigma,p',e\n1,1,0.9\n2,2,0.8\n");
  EXPECT_EQ(two.code, 4);
  EXPECT_THAT(
      two.err,
      HasSubstr("columns \"sigma\" and \"p'\" may both be P_star: choose one with --columns P_star=..."));
}

TEST(MeasuredTables, InPercentOrNotAreAskedAboutWhereTheNumbersContradict) {
  struct Asked {
    const char *header, *numbers, *name, *answer;
  };
  for (const Asked& asked : {Asked{"e", "105;95;85", "void_ratio", "void_ratio=e [%]"},
                             {"phi", "51;53;55", "phi", "phi=phi [%]"},
                             {"porosity", "49;47;45", "porosity", "porosity=porosity [%]"},
                             {"phi [%]", "0.51;0.53;0.55", "phi", "phi=phi [1]"},
                             {"e [%]", "0.95;0.85;0.75", "void_ratio", "void_ratio=e [1]"}}) {
    std::string table = fmt::format("P_star;{}\n", asked.header);
    std::string_view rest = asked.numbers;
    for (const double P : {10.0, 20.0, 10.0}) {
      table += fmt::format("{};{}\n", P, rest.substr(0, rest.find(';')));
      rest.remove_prefix(std::min(rest.find(';') + 1, rest.size()));
    }
    for (const char* which : kFits) {
      const Outcome o = fit(which, table);
      EXPECT_EQ(o.code, 4) << which << ", " << asked.header;
      EXPECT_THAT(o.err, AllOf(HasSubstr("stdin:2: "), HasSubstr(asked.name), HasSubstr("percent")))
          << asked.header;
    }
    EXPECT_EQ(fit("cycle", table, {"--columns", asked.answer}).code, 0) << asked.header;
  }
  const Outcome compacted =
      floc_arguments({"fit", "dynamic-compaction", "-"}, "e,p,sc,se\n95,1,1,1\n85,2,1,1\n");
  EXPECT_EQ(compacted.code, 4);
  EXPECT_THAT(compacted.err,
              HasSubstr("stdin:2: e is 85 and more in every row: is it in percent? Answer yes with --columns "
                        "\"e=e [%]\", or no with --columns \"e=e [1]\""));
  EXPECT_EQ(fit("cycle", "p,e\n1,90\n2,50\n3,4\n2,4.1\n").code, 4);
  const std::string loose = "P_star;e\n10;105\n20;95\n10;96\n";
  EXPECT_EQ(fit("cycle", loose, {"--columns", "void_ratio=e [1]"}).code, 0);
}

TEST(MeasuredTables, AreNotMistakenWhereTheUnitSaysThatANameMeansSomethingElse) {
  const Outcome o = fit("cycle", "p [MPa],D [mm],e\n1,10,0.9\n2,10,0.8\n1,10,0.82\n");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("pressure in MPa, void ratio; 1 reversal"));
}

TEST(MeasuredTables, ThatLackANumberAreRefusedWithTheOptionThatGivesIt) {
  const auto refused = [](const std::string& table, const std::string& words,
                          std::vector<std::string> options = {}) {
    const Outcome o = fit("cycle", table, std::move(options));
    EXPECT_EQ(o.code, 4) << table;
    EXPECT_THAT(o.err, HasSubstr(words)) << table;
  };
  refused("p,density\n1,2\n2,2.1\n",
          "the column \"density\" (bulk density) could be used with --columns particle_density=NUMBER");
  refused("p,strain\n1,.01\n2,.02\n",
          "the column \"strain\" (axial strain) could be used with --columns initial_void_ratio=NUMBER");
  refused("p,h\n1,20\n2,19\n",
          "the column \"h\" (height) could be used with --columns initial_void_ratio=NUMBER or "
          "solid_height=NUMBER");
  refused("p,density\n1,2\n2,2.8\n",
          "stdin:3: bulk_density = 2.8: expected a density up to the density of the particles",
          {"--columns", "particle_density=2.7"});
  refused("p [mm],e\n1,0.9\n2,0.8\n", "have the unit mm: expected a unit of pressure");
  refused("p,e [kPa]\n1,0.9\n2,0.8\n", "the column \"e [kPa]\" has the name of a void ratio, but not its unit");
  refused("p,e [kPa]\n1,0.9\n2,0.8\n", "found the unit kPa here: expected a number without unit, or in %",
          {"--columns", "void_ratio=e"});
}

TEST(MeasuredTables, AreShownByInfoWithoutAFit) {
  const ScratchDirectory scratch;
  write_text(scratch.file("t.txt"),
             "Test 12\n\nDruck\tPorenzahl\tBemerkung\n[MPa]\t[%]\t\n1,0\t90,5\tx\n1,0\t90,0\t\n2,5\t80,0\t\n");
  const Outcome o = floc_arguments({"info", scratch.file("t.txt"), "--format", "csv", "--columns",
                                    "header,quantity,unit,n_numbers,low,high"});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(
      o.out,
      "header,quantity,unit,n_numbers,low,high\nDruck,P_star,MPa,3,1,2.5\nPorenzahl,void_ratio,%,3,80,90.5\n"
      "Bemerkung,,,0,,\n");
  EXPECT_THAT(
      o.err,
      AllOf(HasSubstr("read 3 rows: pressure in MPa, void ratio in %; 0 reversals; separated by tabs, decimal "
                      "commas, columns named in line 3, below a title, units in line 4"),
            HasSubstr("1 row has the pressure of the next row")));
  write_text(scratch.file("g.dat"), "x y radius\n0 0 1\n2 0 1\n");
  EXPECT_THAT(floc_arguments({"info", scratch.file("g.dat")}).err,
              HasSubstr("read 2 rows: grains with x, y, radius"));
  write_text(scratch.file("h.csv"), "p,thickness\n1,2\n");
  const Outcome needs = floc_arguments({"info", scratch.file("h.csv"), "--format", "csv"});
  EXPECT_EQ(needs.code, 4);
  EXPECT_THAT(needs.out, HasSubstr("thickness,height"));
}

}  // namespace
}  // namespace floc::test
