#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

#include "floc/io/csv.h"
#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

double degrees_of_sine(double sine) {
  return std::asin(sine) * 180.0 / std::numbers::pi;
}
double degrees_of_tangent(double tangent) {
  return std::atan(tangent) * 180.0 / std::numbers::pi;
}

/// Returns a parameter of the first test of a kind, from the csv table that `fit strength` prints.
double value_of(const std::string& printed, const std::string& sample, const std::string& kind,
                const std::string& parameter) {
  std::istringstream in(printed);
  const CsvTable table = CsvTable::parse("printed", in);
  for (int row = 0; row < table.n_rows(); ++row)
    if (table.text(row, table.column("sample")).starts_with(sample) &&
        table.text(row, table.column("test")) == kind &&
        table.text(row, table.column("parameter")) == parameter)
      return table.number(row, table.column("value"));
  ADD_FAILURE() << "no " << parameter << " of " << sample << ", " << kind << " in\n" << printed;
  return std::nan("");
}

/// Table of a drained test under a lateral stress (kPa). The axial stress increases linearly to the peak and then stays
/// constant. The volume grows during the first half of the test.
std::string drained_table(double lateral, double peak, const std::string& unit, double scale, double percent) {
  std::string text = fmt::format("eps [{}],s1 [{}],s3 [{}],eps_v\n", percent == 1 ? "-" : "%", unit, unit);
  for (int k = 0; k <= 40; ++k)
    text += fmt::format("{},{},{},{}\n", percent * 0.005 * k,
                        scale * (lateral + (peak - lateral) * std::min(1.0, k / 10.0)), scale * lateral,
                        -0.0002 * std::min(k, 20));
  return text;
}

TEST(FitStrength, OfTestsInDifferentUnitsIsOneMohrCoulombLine) {
  const ScratchDirectory dir;
  // Mohr-Coulomb line with friction angle phi and cohesion c: sigma_1 = N sigma_3 + 2 c sqrt(N), N = (1 + sin
  // phi)/(1 - sin phi). For 30 degrees and 10 kPa, N = 3 and 2 c sqrt(N) = 20 sqrt(3) kPa.
  const auto peak = [](double lateral) { return 3 * lateral + 20 * std::sqrt(3.0); };
  write_text(dir.file("a.csv"), drained_table(50, peak(50), "kPa", 1, 1));
  write_text(dir.file("b.csv"), drained_table(100, peak(100), "MPa", 1e-3, 100));
  write_text(dir.file("c.csv"), drained_table(400, peak(400), "Pa", 1e3, 1));
  const Outcome o = run_floc(
      "fit strength a.csv b.csv c.csv "
      "--columns sigma1=s1,sigma3=s3,strain=eps,volumetric_strain=eps_v --format csv",
      dir.path());
  ASSERT_EQ(o.code, 0) << o.err;
  for (const char* state : {"peak", "critical"}) {
    EXPECT_NEAR(value_of(o.out, "pooled", "drained", std::string("friction_angle_") + state), 30, 1e-6);
    EXPECT_NEAR(value_of(o.out, "pooled", "drained", std::string("cohesion_") + state), 10, 1e-5);
  }
  EXPECT_NEAR(value_of(o.out, "b.csv", "drained", "strain_peak"), 0.05, 1e-12);
  EXPECT_NEAR(value_of(o.out, "b.csv", "drained", "secant_angle_peak"),
              degrees_of_sine((peak(100) - 100) / (peak(100) + 100)), 1e-9);
  EXPECT_THAT(o.out, HasSubstr(",kPa,3\n"));
}

TEST(FitStrength, OfSamplesAtFailureIsTheLineThroughTheRows) {
  const Outcome o = run_floc("fit strength - --format json", ScratchDirectory().path(),
                             "sigma1,sigma3\n200,50\n350,100\n650,200\n");
  ASSERT_EQ(o.code, 0) << o.err;
  const json parameters = json::parse(o.out).at(0).at("parameters");
  // The rows lie on sigma_1 = 3 sigma_3 + 50: N = 3 and 2 c sqrt(N) = 50.
  EXPECT_NEAR(parameters.at("friction_angle_peak").at("value").get<double>(), 30, 1e-9);
  EXPECT_NEAR(parameters.at("cohesion_peak").at("value").get<double>(), 25 / std::sqrt(3.0), 1e-9);
}

TEST(FitStrength, OfOneSampleAtFailureIsItsSecantAngle) {
  for (const auto& [table, angle] : {std::pair("sigma1,sigma3\n50,10\n", degrees_of_sine(40.0 / 60.0)),
                                     std::pair("sigma_n,tau\n200,100\n", degrees_of_tangent(0.5))}) {
    const Outcome o = run_floc("fit strength - --format csv", ScratchDirectory().path(), table);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_NEAR(value_of(o.out, "pooled", "failure", "secant_angle_peak"), angle, 1e-9);
  }
}

TEST(FitStrength, UndrainedNeedsNoVolumetricStrain) {
  const std::string rows = "0,100,100\n0.02,150,60\n0.04,150,60\n0.06,150,60\n0.08,150,60\n0.1,150,60\n";
  const Outcome o = run_floc("fit strength - --kind undrained --format csv", ScratchDirectory().path(),
                             "strain,sigma1,sigma3\n" + rows);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NEAR(value_of(o.out, "stdin", "undrained", "undrained_strength_peak"), 45.0, 1e-9) << o.out;
}

TEST(FitStrength, OfRunsAgreesWithTheColumnsOfTheirPaths) {
  const ScratchDirectory dir;
  const std::string scenes = source_directory() + "/data/scenes/";
  const std::string small = " --set grains.count=60 --set load.0.strain_step=0.01 --set load.0.strain=0.1";
  ASSERT_EQ(run_floc("run " + scenes + "biaxial_dense.toml -o drained" + small, dir.path()).code, 0);
  ASSERT_EQ(run_floc("run " + scenes + "constant_volume.toml -o undrained" + small, dir.path()).code, 0);
  const Outcome o = run_floc("fit strength drained undrained --critical-from 0.05 --format csv", dir.path());
  EXPECT_EQ(o.code, 0) << o.err;
  for (const std::string kind : {"drained", "undrained"}) {
    const CsvTable path = CsvTable::read(dir.file(kind + "/path.csv"));
    double largest = 0, q = 0;
    for (int row = 1; row < path.n_rows(); ++row) {
      largest = std::max(largest, path.number(row, path.column("mobilised_friction")));
      q = std::max(q, path.number(row, path.column("q")));
    }
    EXPECT_NEAR(value_of(o.out, kind, kind, "secant_angle_peak"), degrees_of_sine(largest), 1e-9);
    if (kind == "undrained") {
      EXPECT_NEAR(value_of(o.out, kind, kind, "undrained_strength_peak"), 0.5 * q, 1e-12);
    }
  }
}

/// Returns the value of a parameter of each test that `fit strength` prints, without the values of all tests.
std::vector<double> values_of(const std::string& printed, const std::string& parameter) {
  std::istringstream in(printed);
  const CsvTable table = CsvTable::parse("printed", in);
  std::vector<double> values;
  for (int row = 0; row < table.n_rows(); ++row)
    if (table.text(row, table.column("parameter")) == parameter &&
        table.text(row, table.column("sample")) != "pooled")
      values.push_back(table.number(row, table.column("value")));
  return values;
}

/// Evaluates the rows of a path that follow an isotropic state.
std::string evaluated(const std::string& columns, const std::string& rows) {
  const ScratchDirectory dir;
  const bool is_sheared = columns.find("shear") != std::string::npos;
  write_text(dir.file("path.csv"), columns + "assembly,,,1,0,1,0" + (is_sheared ? ",,\n" : "\n") + rows);
  const Outcome o = run_floc("fit strength path.csv --format csv", dir.path());
  EXPECT_EQ(o.code, 0) << o.err;
  return o.out;
}

/// Rows of a stage of simple shear in steps of `step`, with a stress ratio of 0.5 in row 5 and `ratio` elsewhere.
std::string sheared_rows(int n, double step, double ratio) {
  std::string rows;
  for (int k = 1; k <= n; ++k)
    rows += fmt::format("shear,simple_shear,2,1,0,1,0,{},{}\n", step * k,
                        n > 6 && k == 5 ? std::copysign(0.5, ratio) : ratio);
  return rows;
}

constexpr char kSheared[] =
    "branch,control,axis,stress_1,strain_1,stress_2,strain_2,shear_strain,shear_stress\n";

/// Stages that follow one another under the same name are one test as long as the strain goes on. Shear strains begin
/// at zero in each stage, whether the next stage begins with a smaller, an equal or a larger strain than the last one.
TEST(FitStrength, StagesThatGoOnAreOneTest) {
  for (const auto& [n, step] : {std::pair(6, 0.01), std::pair(3, 0.1), std::pair(1, 0.1), std::pair(2, 0.3)}) {
    const std::string rows =
        sheared_rows(10, 0.01, 0.4) + sheared_rows(n, step, 0.45) + sheared_rows(1, 0.01, 0.6);
    const std::string out = evaluated(kSheared, rows);
    ASSERT_EQ(values_of(out, "strain_peak").size(), 1u);
    EXPECT_NEAR(values_of(out, "strain_peak")[0], 0.1 + n * step + 0.01, 1e-12);
    EXPECT_NEAR(values_of(out, "secant_angle_peak")[0], degrees_of_tangent(0.6), 1e-9);
  }
}

/// A reversed strain is a test of its own, with its own peak, and the values of all tests leave it out.
TEST(FitStrength, ReversedStrainsAreTestsOfTheirOwn) {
  const std::string sheared = evaluated(kSheared, sheared_rows(10, 0.01, 0.4) + sheared_rows(8, -0.01, -0.3));
  EXPECT_THAT(values_of(sheared, "strain_peak"), ElementsAre(DoubleNear(0.05, 1e-12), DoubleNear(0.05, 1e-12)));
  EXPECT_NEAR(values_of(sheared, "secant_angle_peak")[0], degrees_of_tangent(0.5), 1e-9);
  EXPECT_THAT(sheared, Not(HasSubstr("pooled")));

  // Compressed to a peak of 3, then pulled to a least axial stress of 0.4; strains under noise do not count.
  std::string rows;
  for (int k = 1; k <= 10; ++k)
    rows += fmt::format("test,triaxial,1,{},{},1,{}\n", k == 5 ? 3.0 : 2.5, 0.01 * k, -0.004 * k);
  rows += "test,triaxial,1,2.5,0.0999999999,1,-0.04\n";
  const std::string forwards = evaluated("branch,control,axis,stress_1,strain_1,stress_2,strain_2\n", rows);
  EXPECT_EQ(values_of(forwards, "secant_angle_peak").size(), 1u);
  for (int k = 1; k <= 10; ++k)
    rows += fmt::format("test,triaxial,1,{},{},1,-0.04\n", k < 3 ? 2.0 : k == 5 ? 0.4 : 0.5, 0.1 - 0.01 * k);
  const std::string both = evaluated("branch,control,axis,stress_1,strain_1,stress_2,strain_2\n", rows);
  EXPECT_THAT(values_of(both, "secant_angle_peak"), ElementsAre(DoubleNear(degrees_of_sine(0.5), 1e-9),
                                                                DoubleNear(degrees_of_sine(0.6 / 1.4), 1e-9)));
  EXPECT_NEAR(values_of(both, "strain_peak")[1], 0.05, 1e-6);
  EXPECT_THAT(both, Not(HasSubstr("pooled")));
}

/// A stage of simple shear without strain holds the packing, and the shear stress is still recorded.
TEST(FitStrength, HoldsInSimpleShearHaveAShearStress) {
  const ScratchDirectory dir;
  const std::string load =
      "load=[{control=\"simple_shear\",strain=0.01,steps=1},{control=\"simple_shear\",strain=0.0,steps=1}]";
  ASSERT_EQ(run_floc("run " + source_directory() + "/data/scenes/demo.toml --set grains.count=60 --set '" +
                         load + "' -o out",
                     dir.path())
                .code,
            0);
  const CsvTable path = CsvTable::read(dir.file("out/path.csv"));
  const int last = path.n_rows() - 1;
  // The packing is at rest, and stays as it is within the tolerances of the equilibrium.
  for (const char* column : {"shear_stress", "mobilised_friction"}) {
    const double held = path.number(last, path.column(column)),
                 before = path.number(last - 1, path.column(column));
    EXPECT_GT(std::abs(before), 1e-4) << column;
    EXPECT_NEAR(held, before, 1e-3 * std::abs(before)) << column;
  }
  EXPECT_EQ(path.number(last, path.column("shear_strain")), 0.0);
}

TEST(FitStrength, OfAnOedometerIsItsK0AndModulus) {
  std::string table = "sigma1 [kPa],sigma3 [kPa],strain [%]\n";
  for (int k = 0; k <= 20; ++k) {
    const double stress = 10 * std::pow(10, 0.1 * k);
    table += fmt::format("{},{},{}\n", stress, 0.45 * stress, 100 * (stress - 10) / 8000);
  }
  const Outcome o = run_floc("fit strength - --kind oedometer --modulus 100,1000 --format csv",
                             ScratchDirectory().path(), table);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NEAR(value_of(o.out, "stdin", "oedometer", "K0"), 0.45, 1e-9);
  EXPECT_NEAR(value_of(o.out, "stdin", "oedometer", "constrained_modulus"), 8000, 1e-3);
}

/// Table of a simple shear test under a normal stress. The shear stress increases linearly to the peak, and then has a
/// plateau.
std::string sheared_table(double normal, double peak, const std::string& unit, double scale) {
  std::string text = fmt::format("sigma_n [{}],tau [{}],gamma [%],eps_v [%]\n", unit, unit);
  for (int k = 0; k <= 40; ++k)
    text += fmt::format("{},{},{},{}\n", scale * normal, scale * peak * std::min(1.0, k / 10.0), 0.5 * k,
                        -0.02 * std::min(k, 20));
  return text;
}

TEST(FitStrength, OfSimpleShearIsTheLineOfItsPlanes) {
  const ScratchDirectory dir;
  const auto peak = [](double normal) { return 12.0 + normal * std::tan(std::numbers::pi / 6.0); };
  write_text(dir.file("a.csv"), sheared_table(50, peak(50), "kPa", 1));
  write_text(dir.file("b.csv"), sheared_table(100, peak(100), "MPa", 1e-3));
  write_text(dir.file("c.csv"), sheared_table(400, peak(400), "kPa", 1));
  const Outcome o = run_floc("fit strength a.csv b.csv c.csv --format csv", dir.path());
  ASSERT_EQ(o.code, 0) << o.err;
  for (const char* state : {"peak", "critical"}) {
    EXPECT_NEAR(value_of(o.out, "pooled", "simple-shear", std::string("friction_angle_") + state), 30, 1e-6);
    EXPECT_NEAR(value_of(o.out, "pooled", "simple-shear", std::string("cohesion_") + state), 12, 1e-6);
  }
  EXPECT_NEAR(value_of(o.out, "a.csv", "simple-shear", "strain_peak"), 0.05, 1e-12);
  // In the rows at the peak, the volume grows by 0.02 % while the shear strain grows by 0.5 %.
  EXPECT_NEAR(value_of(o.out, "a.csv", "simple-shear", "dilatancy_angle"), degrees_of_tangent(0.04), 2.0);
  const Outcome rows =
      run_floc("fit strength - --format csv", dir.path(), "sigma_n,tau\n50,40\n100,70\n200,130\n");
  EXPECT_NEAR(value_of(rows.out, "pooled", "failure", "cohesion_peak"), 10, 1e-9) << rows.err;
}

TEST(FitStrength, OfACampaignIsThatOfTheRunsOfAllItsCases) {
  const ScratchDirectory dir;
  const std::string scene = source_directory() + "/data/scenes/disks_shear_demo.toml";
  for (const char* one : {"runs/a/seed-1", "runs/a/seed-2", "runs/b/seed-1"})
    ASSERT_EQ(
        run_floc(fmt::format("run {} -o campaign/{} --seed {} --set grains.count=40 --set load.0.strain=0.15",
                             scene, one, one[12]),
                 dir.path())
            .code,
        0);
  const Outcome o = run_floc("fit strength campaign --format csv", dir.path());
  EXPECT_NE(o.code, 4) << o.err;
  const CsvTable path = CsvTable::read(dir.file("campaign/runs/a/seed-1/path.csv"));
  double largest = 0;
  for (int row = 1; row < path.n_rows(); ++row)
    largest = std::max(largest, path.number(row, path.column("mobilised_friction")));
  EXPECT_NEAR(value_of(o.out, "campaign/runs/a/seed-1", "simple-shear", "secant_angle_peak"),
              degrees_of_tangent(largest), 1e-9);
  EXPECT_THAT(o.out, HasSubstr("campaign/runs/b/seed-1"));
  EXPECT_THAT(o.out, HasSubstr("pooled,,simple-shear,secant_angle_peak"));
}

TEST(FitStrength, OfWhatIsNoTestIsRefusedInWords) {
  const auto fit = [](const std::string& table, const std::string& options = "") {
    return run_floc("fit strength - " + options, ScratchDirectory().path(), table);
  };
  EXPECT_EQ(fit("P,phi\n1,0.5\n").code, 4);
  EXPECT_THAT(fit("P,phi\n1,0.5\n").err, HasSubstr("sigma1"));
  EXPECT_THAT(fit("sigma1 [kPa],sigma3 [m]\n1,0.5\n").err,
              HasSubstr("expected two known units of one quantity"));
  EXPECT_THAT(fit("sigma1,sigma3,strain [mm],volumetric_strain\n1,0.5,1,1\n").err,
              HasSubstr("expected strains without unit or in percent"));
  EXPECT_THAT(fit("sigma1,sigma3\n2,1\n", "--modulus 3,2").err,
              HasSubstr("--modulus: 3,2: expected two stresses"));
  const Outcome two = fit("sigma1,sigma3\n3,1\n6,2\n");
  EXPECT_THAT(two.err,
              HasSubstr("no Mohr-Coulomb line was fitted to the states of the peak: there are 2 tests"));
  const Outcome isotropic = run_floc("fit strength " + source_directory() + "/data/tables/demo/seed-1");
  EXPECT_EQ(isotropic.code, 3);
  EXPECT_THAT(isotropic.err, HasSubstr("the table contains no test with axial strain or simple shear"));
}

}  // namespace
}  // namespace floc::test
