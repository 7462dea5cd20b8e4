#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "floc/io/csv.h"
#include "support/run_arguments.h"
#include "support/small_run.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

struct NamedUnit {
  const char* name;
  double size;  ///< Pa
};
constexpr NamedUnit kPressures[] = {{"Pa", 1.0},  {"hPa", 1e2}, {"kPa", 1e3},   {"MPa", 1e6},
                                    {"GPa", 1e9}, {"bar", 1e5}, {"kN/m2", 1e3}, {"N/mm^2", 1e6}};

/// Table of one loading with lambda = 0.2 and a little scatter.
/// @param header  name of the pressure column
/// @param size  unit of the printed pressures (Pa)
std::string path_in(const std::string& header, double size, int sample) {
  std::string text = header + ",phi\n";
  for (int k = 0; k < 12; ++k) {
    const double P = 1e3 * std::pow(1.5, k);
    text += fmt::format("{},{}\n", P / size,
                        1.0 / (2.8 - 0.2 * std::log(P / 1e3) + 1e-3 * std::sin(7.0 * k + sample)));
  }
  return text;
}

/// Some commands pool several tables or columns and convert their units. Every pair of units must give the same result
/// as equal units, and a table without a unit is refused.
TEST(UnitsOfTables, AreConvertedOrRefusedWhereTablesArePooled) {
  const ScratchDirectory scratch;
  int n_pairs = 0, n_refused = 0;
  const auto pooled_lambda = [&](const std::string& a, double of_a, const std::string& b, double of_b) {
    write_text(scratch.file("a.csv"), path_in(a, of_a, 1));
    write_text(scratch.file("b.csv"), path_in(b, of_b, 2));
    return run_floc("fit consolidation a.csv b.csv --law log --format json", scratch.path());
  };
  const Outcome same = pooled_lambda("P_star [Pa]", 1.0, "P_star [Pa]", 1.0);
  ASSERT_EQ(same.code, 0) << same.err;
  const double lambda = json::parse(same.out).back()["parameters"]["lambda"]["value"];
  for (const NamedUnit& a : kPressures)
    for (const NamedUnit& b : kPressures) {
      const Outcome o =
          pooled_lambda(fmt::format("P_star [{}]", a.name), a.size, fmt::format("P_star ({})", b.name), b.size);
      ASSERT_EQ(o.code, 0) << a.name << ", " << b.name << ": " << o.err;
      const json fits = json::parse(o.out);
      ASSERT_EQ(fits.size(), 3u);
      EXPECT_NEAR(fits.back()["parameters"]["lambda"]["value"].get<double>(), lambda, 1e-9)
          << a.name << ", " << b.name;
      for (const json& fit : fits) {
        EXPECT_EQ(fit["pressure_unit"], a.name);
        EXPECT_EQ(fit["n_points"], 12);
        EXPECT_NEAR(fit["window"][0].get<double>() * a.size, 1e3, 1e-6);
      }
      ++n_pairs;
    }
  for (const auto& [a, b] : {std::pair{"P_star [kPa]", "P_star"},
                             {"P_star", "P_star [Pa]"},
                             {"P_star [kPa]", "P_star [N/m]"},
                             {"P_star [kPa]", "P_star [turnips]"}}) {
    const Outcome o = pooled_lambda(a, 1.0, b, 1.0);
    EXPECT_EQ(o.code, 4) << a << ", " << b;
    EXPECT_THAT(o.err, HasSubstr("b.csv: found ")) << a << ", " << b;
    EXPECT_THAT(o.err, HasSubstr("expected two known units of one quantity")) << a << ", " << b;
    EXPECT_EQ(json::parse(o.out).size(), 1u);
    const Outcome plot = run_floc("plot a.csv b.csv --show consolidation -o p.svg", scratch.path());
    EXPECT_EQ(plot.code, 4);
    EXPECT_THAT(plot.err, HasSubstr("expected two known units of one quantity"));
    ++n_refused;
  }
  for (const char* unit : {"mm", "%", "g/cm3"}) {
    const Outcome o = pooled_lambda("P_star [kPa]", 1.0, fmt::format("P_star [{}]", unit), 1.0);
    EXPECT_EQ(o.code, 4);
    EXPECT_THAT(o.err, HasSubstr(fmt::format("have the unit {}: expected a unit of pressure", unit)));
  }
  EXPECT_EQ(pooled_lambda("P_star [-]", 1.0, "P_star", 1.0).code, 0);
  fmt::print("consolidation and its plot: {} pairs of units converted, {} refused\n", n_pairs, n_refused);
}

TEST(UnitsOfTables, ModuliOfAStateTakeTheUnitOfTheTable) {
  const ScratchDirectory scratch;
  std::ofstream(scratch.file("grains.csv"))
      << "x,y,z,radius\n0,0,0,0.5\n0.999,0,0,0.5\n0,0.999,0,0.5\n0.999,0.999,0,0.5\n";
  const auto convert = [&](const std::string& options) {
    return run_floc("convert grains.csv --overwrite --law normal.stiffness=1e6 --tolerance 1e9 " + options,
                    scratch.path());
  };
  ASSERT_EQ(convert("solid.h5 --units SI --cell \"1.998,0,0;0,1.998,0;0,0,0.999\"").code, 0);
  ASSERT_EQ(convert("bare.h5 --cell \"1.998,0,0;0,1.998,0;0,0,0.999\"").code, 0);
  ASSERT_EQ(convert("disks.h5 --dimension 2 --units SI --cell \"1.998,0;0,1.998\"").code, 0);
  const auto fit = [&](const std::string& header, double unit, const std::string& state) {
    std::string table = header + ",phi\n";
    for (const double P : {2e3, 1.5e3, 1e3, 0.5e3, 0.0})
      table += fmt::format("{},{}\n", P / unit, 0.5 * std::exp(P / 9e5));
    return run_floc("fit elastic - --format json --state " + state, scratch.path(), table);
  };
  const auto of = [](const Outcome& o, const char* key) {
    return json::parse(o.out).at(0).at("state").at(key).get<double>();
  };
  const Outcome expected = fit("P", 1.0, "solid.h5");
  ASSERT_EQ(expected.code, 0) << expected.err;
  // Simple cubic crystal of spheres of spacing d: B = K_N/(3 d).
  EXPECT_NEAR(of(expected, "B"), 1e6 / (3 * 0.999), 1e-3);
  for (const auto& [header, unit, state] : {std::tuple{"P [Pa]", 1.0, "solid.h5"},
                                            {"P [kPa]", 1e3, "solid.h5"},
                                            {"P (MPa)", 1e6, "solid.h5"},
                                            {"P_star [bar]", 1e5, "solid.h5"},
                                            {"P [kN/m]", 1e3, "disks.h5"}}) {
    const Outcome o = fit(header, unit, state), bare = fit("P", 1.0, state);
    ASSERT_EQ(o.code, 0) << header << ": " << o.err;
    for (const char* key : {"B", "B_S", "P"})
      EXPECT_NEAR(of(o, key) * unit / of(bare, key), 1.0, 1e-12) << header << ", " << key;
    EXPECT_NEAR(of(o, "rms"), of(bare, "rms"), 1e-12) << header;
  }
  for (const auto& [header, state] : {std::pair{"P [kPa]", "disks.h5"},
                                      {"P [N/m]", "solid.h5"},
                                      {"P [kPa]", "bare.h5"},
                                      {"P [turnips]", "solid.h5"}}) {
    const Outcome o = fit(header, 1.0, state);
    EXPECT_EQ(o.code, 4) << header;
    EXPECT_THAT(o.err, HasSubstr(std::string(state) + ": found ")) << header;
    EXPECT_THAT(o.err, HasSubstr("expected two known units of one quantity")) << header;
  }
}

TEST(UnitsOfTables, OfColumnsOfOneTableAreMadeTheSame) {
  const ScratchDirectory scratch;
  const auto samples = [&](const std::string& sc, double of_sc, const std::string& se, double of_se) {
    std::string text = fmt::format("e,p [kPa],{},{}\n", sc, se);
    for (const double p : {0.01, 0.1, 0.5, 1.0})
      for (const double k : {500.0, 2e3, 1e4, 5e4, 2e5})
        for (const double eta : {1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.05, 0.1, 0.2, 0.5, 2.0, 15.0}) {
          const double c = eta * std::sqrt(p * k), x = eta / 0.045;
          if (c > 0.1 * k) continue;
          const double e_max = 0.76 + 1.0 / (1.0 + 0.24 * std::log(p / 0.01));
          const double right = 1.0 / (0.475 * std::pow(x, 0.74) + (1 / 1.55 - 0.475) * std::pow(x, 2.3));
          text += fmt::format("{},{},{},{}\n", 0.76 + (e_max - 0.76) / (1.0 + right), p, c / of_sc, k / of_se);
        }
    write_text(scratch.file("t.csv"), text);
    return run_floc("fit dynamic-compaction t.csv --format json", scratch.path());
  };
  int n = 0;
  for (const NamedUnit& c : kPressures)
    for (const NamedUnit& k : kPressures) {
      if (&c != &kPressures[0] && &k != &kPressures[2]) continue;
      const Outcome o =
          samples(fmt::format("sc [{}]", c.name), c.size / 1e3, fmt::format("se [{}]", k.name), k.size / 1e3);
      ASSERT_EQ(o.code, 0) << o.err;
      EXPECT_NEAR(json::parse(o.out).at(0)["parameters"]["e_min"]["value"].get<double>(), 0.76, 1e-6);
      ++n;
    }
  fmt::print("dynamic compaction: {} pairs of units\n", n);
  const Outcome missing = samples("sc", 1.0, "se [kPa]", 1.0);
  EXPECT_EQ(missing.code, 4);
  EXPECT_THAT(missing.err, HasSubstr("column sc: found no unit here, but column p has the unit kPa"));
}

class UnitsOfRuns : public SmallRun {};

TEST_F(UnitsOfRuns, AreConvertedOrRefusedWhereRunsAreCompared) {
  namespace fs = std::filesystem;
  fs::copy(file("run"), file("other"), fs::copy_options::recursive);
  const std::string path = content_of(file("run/path.csv"));
  const auto with_header = [&](const std::string& run, const std::string& header) {
    std::string text = path;
    write_text(file(run + "/path.csv"), text.replace(text.find(",P,"), 3, "," + header + ","));
  };
  const auto compared = [&](const std::string& a, const std::string& b) {
    with_header("run", a);
    with_header("other", b);
    return floc("compare run other --format json");
  };
  EXPECT_EQ(compared("P [kPa]", "P [kPa]").code, 0);
  EXPECT_EQ(compared("P [kPa]", "P [kN/m2]").code, 0);
  const Outcome factor = compared("P [kPa]", "P [Pa]");
  EXPECT_EQ(factor.code, 5) << factor.err;
  EXPECT_THAT(json::parse(factor.out).back()["differing"].get<std::string>(), HasSubstr("P"));
  EXPECT_EQ(compared("P [kPa]", "P").code, 4);
  EXPECT_EQ(compared("P", "P [m]").code, 4);
  with_header("run", "P");
  // Some commands recognise columns only by the exact names that floc writes. These commands refuse a column with the
  // name of floc but with another unit.
  with_header("other", "P_star [kPa]");
  write_text(file("m.csv"), "P_star [kPa],B,B_S,G,B_reuss,B_voigt,G_voigt\n1,1,1,1,1,1,1\n");
  EXPECT_EQ(floc("plot m.csv --show moduli -o m.svg").code, 4);
}

/// Fixture: the beads of the shipped scene, compressed along one axis and then unloaded.
class OedometerOfBeads : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new ScratchDirectory;
    std::string scene = content_of(source_directory() + "/data/scenes/spheres_demo.toml");
    scene.resize(scene.find("[[load]]"));
    write_text(scratch_->file("s.toml"), scene + R"(
[[load]]
to = 100e3
steps_per_decade = 1
[[load]]
control = "oedometric"
to = 1e6
steps = 3
[[load]]
control = "oedometric"
to = 200e3
steps = 4
[equilibrium]
force = 1e-4
moment = 1e-4
stress = 1e-4
energy = 1e-7
)");
    const Outcome made = run_floc("run s.toml -o run --set grains.count=60 --set run.seed=1", scratch_->path());
    ASSERT_EQ(made.code, 0) << made.err;
  }
  static void TearDownTestSuite() { delete scratch_; }
  static Outcome floc(const std::string& arguments) { return run_floc(arguments, scratch_->path()); }

  inline static ScratchDirectory* scratch_ = nullptr;
};

/// B and M are slopes between neighbouring states of the unloading, against ln Phi: B is the slope of the mean stress,
/// and M that of the stress on the driven axis.
TEST_F(OedometerOfBeads, HasBOfItsMeanAndMOfItsDrivenStress) {
  const Outcome o = floc("fit elastic run --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(
      o.err,
      HasSubstr("in rows of an oedometer test, the reduced pressure P* is computed from the mean stress"));
  const json fit = json::parse(o.out).back();
  EXPECT_EQ(fit["stress"], "mean");
  const CsvTable path = CsvTable::read(scratch_->file("run/path.csv"));
  const auto at = [&](int row, const std::string& column) { return path.number(row, path.column(column)); };
  const int first = fit["fitted_rows"].front(), last = fit["fitted_rows"].back();
  const std::string driven = fmt::format("stress_{}", path.integer(last, path.column("axis")));
  const double change = std::log(at(first, "phi") / at(last, "phi"));
  const double mean = (at(first, "p") - at(last, "p")) / change;
  const double along = (at(first, driven) - at(last, driven)) / change;
  EXPECT_GT(along / mean, 1.2);  // the two slopes differ clearly
  const json B = fit["parameters"]["B"], M = fit["parameters"]["M"];
  if (!B["value"].is_null()) {
    EXPECT_NEAR(B["value"].get<double>() / mean, 1.0, 0.15);
  }
  if (!M["value"].is_null()) {
    EXPECT_NEAR(M["value"].get<double>() / along, 1.0, 0.15);
  }
  EXPECT_TRUE(B["value"].is_number() || M["value"].is_number());
  EXPECT_GT(fit["state"]["M"].get<double>(), fit["state"]["B"].get<double>());
}

TEST_F(OedometerOfBeads, SaysWhichStressEveryFitTakes) {
  int n = 0;
  for (const auto& [command, stress] : {std::pair{"fit elastic run", "mean"},
                                        {"fit cycle run", "driven"},
                                        {"fit consolidation run --law log", "driven"},
                                        {"fit consolidation run --law log --stress mean", "mean"},
                                        {"plot run --show consolidation -o p.svg", "driven"}}) {
    const Outcome o = floc(command);
    EXPECT_THAT(
        o.err,
        HasSubstr(fmt::format(
            "in rows of an oedometer test, the reduced pressure P* is computed from the {} stress", stress)))
        << command;
    if (std::string(command).starts_with("fit")) {
      EXPECT_THAT(o.out, HasSubstr(",stress")) << command;
    }
    ++n;
  }
  fmt::print("{} commands say which stress they take\n", n);
}

TEST_F(OedometerOfBeads, NamesTheStressOnItsDrivenAxisBesideTheMean) {
  const CsvTable path = CsvTable::read(scratch_->file("run/path.csv"));
  const int last = path.n_rows() - 1;
  const auto at = [&](const CsvTable& table, int row, const std::string& column) {
    return table.number(row, table.column(column));
  };
  EXPECT_EQ(at(path, 0, "P_driven"), at(path, 0, "P"));
  EXPECT_NEAR(at(path, last, "P_driven"), 200e3, 1e-6);
  EXPECT_NEAR(at(path, last, "P_driven_star") / at(path, last, "P_star"),
              at(path, last, "P_driven") / at(path, last, "P"), 1e-12);
  const std::string state = "run/" + path.text(last, path.column("state"));
  for (const char* command : {"info ", "moduli ", "network "}) {
    std::istringstream printed(floc(command + state + " --format csv").out);
    const CsvTable row = CsvTable::parse(command, printed);
    EXPECT_NEAR(at(row, 0, "P_driven") / 200e3, 1.0, 1e-3) << command;
    EXPECT_GT(std::abs(at(row, 0, "P") / at(row, 0, "P_driven") - 1.0), 0.05) << command;
  }
  ASSERT_EQ(floc("plot run --show coordination -o z.svg").code, 0);
  EXPECT_THAT(content_of(scratch_->file("z.gp")), HasSubstr("P* of the mean stress"));
  EXPECT_THAT(floc("plot " + state + " --show forces -o f.svg").err, testing::Not(HasSubstr("floc:")));
  EXPECT_THAT(content_of(scratch_->file("f.gp")) + content_of(scratch_->file("f.svg")), HasSubstr("(driven)"));
}

/// A stage triples the adhesion, and therefore also triples the stress that corresponds to P* = 1.
TEST(UnitOfReducedPressure, IsThatOfTheFirstRows) {
  const ScratchDirectory scratch;
  write_text(scratch.file("path.csv"), R"(step,branch,P_star,P,phi,state
0,assembly,0.5,0.5,0.500,a.h5
1,load,1,1,0.520,b.h5
2,load,2,2,0.540,c.h5
3,load 2,1,3,0.550,d.h5
4,load 2,2,6,0.575,e.h5
5,load 2,4,12,0.600,f.h5
6,load 2,8,24,0.625,g.h5
)");
  const Outcome o = run_floc("fit consolidation path.csv --law log --format json", scratch.path());
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(
      o.err,
      HasSubstr("row 3: the unit of the reduced pressure P* changes from a stress of 1 to a stress of 3"));
  const Outcome cycle = run_floc("fit cycle path.csv", scratch.path());
  EXPECT_EQ(cycle.code, 3);
}

}  // namespace
}  // namespace floc::test
