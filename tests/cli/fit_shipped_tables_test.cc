#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kOedometer = source_directory() + "/data/tables/oedometer/oedometer.csv";
const std::string kReload = source_directory() + "/data/tables/reload";

/// Parameters of the clay for which data/tables/oedometer/make.py computed the table.
constexpr double kLambda = 0.110, kKappa = 0.020, kLargestStress = 1600.0;

void expect_inside(const json& parameter, double truth) {
  EXPECT_LT(parameter["low95"], truth);
  EXPECT_GT(parameter["high95"], truth);
}

TEST(Oedometer, VirginSlopeIsThatItWasMadeWith) {
  const Outcome o = run_floc("fit consolidation " + kOedometer +
                             " --loading virgin --law log --window 200,6400 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json fit = json::parse(o.out).at(0);
  // The table has two rows per load: the first right after loading, the second after creep. The second row is fitted.
  // At 1600 kPa, where the path was unloaded and loaded again, the fit uses the row of the first loading.
  EXPECT_EQ(fit["rows_used"], json({12, 14, 16, 18, 35, 37}));
  EXPECT_EQ(fit["pressure_unit"], "kPa");
  expect_inside(fit["parameters"]["lambda"], kLambda);
  EXPECT_NEAR(fit["parameters"]["lambda"]["value"], kLambda, 0.01 * kLambda);
}

TEST(Oedometer, LoopsAndCreepAreRecognised) {
  const Outcome o = run_floc("fit consolidation " + kOedometer + " --law log --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json out = json::parse(o.out).at(0)["rows_left_out"];
  EXPECT_EQ(out["zero_pressure"], json({0}));
  EXPECT_EQ(out["unloading"], json({19, 20, 21, 22, 23, 38, 39, 40, 41, 42}));
  EXPECT_EQ(out["reloading"], json({25, 27, 29, 31, 33}));
  EXPECT_EQ(out["later_virgin"], json({35, 37}));
  EXPECT_EQ(out["hold"], json({1, 3, 5, 7, 9, 11, 13, 15, 17, 24, 26, 28, 30, 32, 34, 36}));
  EXPECT_THAT(o.err, HasSubstr("read 43 rows: pressure in kPa, void ratio; 3 reversals"));
}

TEST(Oedometer, ReloadingTellsThePressureItHadSeen) {
  const Outcome o = run_floc("fit preconsolidation " + kOedometer + " --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json fit = json::parse(o.out).at(0);
  EXPECT_EQ(fit["largest_before"], kLargestStress);
  const json P_c = fit["parameters"]["P_c"];
  expect_inside(P_c, kLargestStress);
  // The interval may be as wide as the ratio of neighbouring pressures of the table, which is two.
  EXPECT_LT(P_c["high95"].get<double>() / P_c["low95"].get<double>(), 2.1);
  expect_inside(fit["parameters"]["kappa"], kKappa);
}

TEST(ShippedPaths, GiveLambdaOfTheModelWithinItsErrors) {
  const Outcome o = run_floc("fit consolidation " + demo_tables() + " --bootstrap 50 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json fits = json::parse(o.out);
  ASSERT_EQ(fits.size(), 9u);
  const json pooled = fits.back();
  EXPECT_EQ(pooled["sample"], "pooled");
  EXPECT_EQ(pooled["errors_from"], "samples");
  // For samples that collapse in jumps, weights follow from the scatter between the samples, not from the scatter of
  // the points of a single sample.
  EXPECT_EQ(pooled["law"], "log");
  EXPECT_EQ(pooled["weights"], "between");
  EXPECT_GT(pooled["regimes"]["jump_distance"], 0.05);
  EXPECT_LT(pooled["regimes"]["jump_distance"], 1.0);
  // For this model with 1400 grains, the published values are lambda = 0.194 and Phi_max = 0.7745 [GRC2008].
  const json lambda = pooled["parameters"]["lambda"], phi_max = pooled["parameters"]["Phi_max"];
  EXPECT_LT(lambda["low95"], 0.194);
  EXPECT_GT(lambda["high95"], 0.194);
  // Samples of 400 grains are denser by a few per cent at most, because of their finite size.
  EXPECT_NEAR(phi_max["value"], 0.7745, 0.03);
  EXPECT_FALSE(pooled["regimes"]["plateau_end"].is_null());
  EXPECT_GT(pooled["bootstrap"]["n"], 25);
}

TEST(ShippedPaths, PublishedProtocolFitsTheMeanFromAPressureOfTheGridOn) {
  const Outcome o =
      run_floc("fit consolidation " + demo_tables() + " --protocol published --P0 0.03 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json fits = json::parse(o.out);
  ASSERT_EQ(fits.size(), 1u);
  EXPECT_EQ(fits[0]["sample"], "pooled");
  EXPECT_EQ(fits[0]["protocol"], "published");
  // P0_star is fixed at the grid pressure that is nearest to 0.03. The window ends at the end of the curve.
  EXPECT_NEAR(fits[0]["parameters"]["P0_star"]["value"], 0.01 * std::pow(10.0, 0.5), 1e-12);
  EXPECT_TRUE(fits[0]["parameters"]["P0_star"]["stderr"].is_null());
  EXPECT_EQ(fits[0]["window"][1], 13.33);
}

TEST(ShippedPaths, ReloadingTellsThePressureTheyHadSeen) {
  const Outcome o = run_floc("fit preconsolidation " + kReload + " --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json fits = json::parse(o.out);
  ASSERT_EQ(fits.size(), 2u);
  for (const json& fit : fits) {
    EXPECT_EQ(fit["largest_before"], 1.0);
    // The fitted P_c agrees with the true value 1 to within the ratio of neighbouring pressures, 1.33.
    EXPECT_NEAR(std::log(fit["parameters"]["P_c"]["value"].get<double>()), 0.0, std::log(1.34));
    EXPECT_LT(fit["parameters"]["P_c"]["low95"], 1.0);
    EXPECT_GT(fit["parameters"]["P_c"]["high95"], 1.0);
    EXPECT_LT(fit["parameters"]["kappa"]["value"], 0.01);
  }
}

TEST(ShippedPaths, UnloadingIsElastic) {
  const Outcome o = run_floc("fit elastic " + demo_tables() + "/seed-1 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json fit = json::parse(o.out).at(0);
  EXPECT_EQ(fit["n_points"], 14);
  EXPECT_TRUE(fit["state"].is_null());
  // `floc moduli` gives B = 24 000 to 28 000 for such states (docs/tutorials/powder2d.md).
  EXPECT_NEAR(fit["parameters"]["B"]["value"], 26000, 6000);
}

TEST(ShippedPaths, UnloadingsThatAreCurvedHaveTheModulusOfTheirStraightPart) {
  for (int seed = 1; seed <= 8; ++seed) {
    const Outcome o =
        run_floc("fit elastic " + demo_tables() + "/seed-" + std::to_string(seed) + " --format json");
    ASSERT_EQ(o.code, 0) << o.err;
    const json B = json::parse(o.out).at(0)["parameters"]["B"];
    // `floc moduli` gives B = 24 000 to 28 000. A line through the whole unloading branch would give too large a B, up
    // to 52 000, and an interval from 38 000 on.
    EXPECT_NEAR(B["value"], 24000, 4000) << seed;
    EXPECT_LT(B["low95"], 24000) << seed;
    EXPECT_GT(B["high95"], 23000) << seed;
  }
}

TEST(ShippedTables, ThePrintedPlateauDoesNotIdentifyTheDenseSideOfACompaction) {
  // Only adhesive samples have p_crit >= p_D. If only these samples are fitted, e_min has no best value: the further
  // e_min changes, the smaller is the misfit.
  const std::string sweep = source_directory() + "/data/tables/compaction/sweep_4000.csv";
  const Outcome o = run_floc("fit dynamic-compaction " + sweep + " --plateau p_crit --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json fit = json::parse(o.out).at(0);
  for (const char* name : {"A", "a"}) {
    EXPECT_FALSE(fit["parameters"][name]["identified"]) << name;
    EXPECT_TRUE(fit["parameters"][name]["value"].is_null()) << name;
  }
}

TEST(FitElastic, TheModulusOfAStateStandsBesideTheFit) {
  const ScratchDirectory dir;
  // Four disks of a compressed triangular lattice, whose bulk modulus is B = sqrt(3)/2 K_N.
  write_text(dir.file("grains.csv"),
             "x,y,r\n0.0,0.0,0.5\n0.999,0.0,0.5\n0.4995,0.8651594,0.5\n1.4985,0.8651594,0.5\n");
  ASSERT_EQ(run_floc("convert grains.csv crystal.h5 --columns radius=r --cell \"1.998,0;0,1.7303188\" --law "
                     "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800",
                     dir.path())
                .code,
            0);
  std::string table = "P,phi\n";
  for (const double P : {2.0, 1.5, 1.0, 0.5, 0.0})
    table += std::to_string(P) + "," + std::to_string(0.9 * std::exp(P / 900)) + "\n";
  const Outcome o = run_floc("fit elastic - --state crystal.h5 --format json", dir.path(), table);
  ASSERT_EQ(o.code, 0) << o.err;
  const json fit = json::parse(o.out).at(0);
  EXPECT_NEAR(fit["state"]["B"], 500 * std::sqrt(3.0), 1e-3);
  // Densities in the table are rounded to six decimals, and their total change is only 2e-3.
  EXPECT_NEAR(fit["parameters"]["B"]["value"], 900, 2);
  EXPECT_TRUE(fit["state"]["rms"].is_number());
}

TEST(Plots, AreDrawnWithDataAndScriptBesideThem) {
  const ScratchDirectory dir;
  const Outcome o = run_floc(
      "fit consolidation " + demo_tables() + "/seed-1 --plot \"a fit's.svg\" --format csv", dir.path());
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string svg = content_of(dir.file("a fit's.svg"));
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr("residual"));
  EXPECT_THAT(content_of(dir.file("a fit's.dat")), HasSubstr("# law"));
  EXPECT_THAT(content_of(dir.file("a fit's.gp")), HasSubstr("multiplot"));
}

TEST(Plots, BadNamesAndFullDisksAreSaid) {
  const ScratchDirectory dir;
  EXPECT_EQ(run_floc("fit consolidation " + demo_tables() + "/seed-1 --plot fit.gif", dir.path()).code, 4);
  EXPECT_EQ(run_floc("fit consolidation " + demo_tables() + "/seed-1 --plot absent/fit.svg", dir.path()).code,
            1);
}

TEST(Units, ComeFromTheHeaderAndStayWithPressures) {
  std::string table = "sigma [kPa],void_ratio\n";
  for (int k = 0; k < 8; ++k) table += std::to_string(100 << k) + "," + std::to_string(1.2 - 0.07 * k) + "\n";
  const Outcome o = run_floc(
      "fit consolidation - --law log --columns P_star=sigma --window 100,20000 --format json", ".", table);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(json::parse(o.out).at(0)["pressure_unit"], "kPa");
  const Outcome csv = run_floc(
      "fit consolidation - --law log --columns P_star=sigma --window 100,20000 --format csv", ".", table);
  EXPECT_THAT(csv.out, HasSubstr("P0_star,100,,,,true,kPa"));
}

/// Table of samples that follow the law, rounded to six decimals.
/// @param at_p_crit  evaluates the plateau at p_crit = sc^2/se instead of p
std::string compacted_samples(bool at_p_crit) {
  std::string table = "e,p,sc,se\n";
  for (const double p : {0.01, 1.0, 10.0, 100.0})
    for (const double sc : {1.5, 3.0, 9.0, 30.0}) {
      const double x = sc / std::sqrt(p * 100) / 0.045;
      const double S = 0.475 * std::pow(x, 0.74) + (1 / 1.55 - 0.475) * std::pow(x, 2.3);
      const double plateau = 1 / (1 + 0.24 * std::log((at_p_crit ? sc * sc / 100 : p) / 0.01));
      table += std::to_string(0.76 + plateau * S / (1 + S)) + "," + std::to_string(p) + "," +
               std::to_string(sc) + ",100\n";
    }
  return table;
}

TEST(FitDynamicCompaction, ReadsATable) {
  for (const bool at_p_crit : {false, true}) {
    const Outcome o = run_floc(
        std::string("fit dynamic-compaction - --format json --plateau ") + (at_p_crit ? "p_crit" : "p"), ".",
        compacted_samples(at_p_crit));
    ASSERT_EQ(o.code, 0) << o.err;
    const json fit = json::parse(o.out).at(0);
    // Void ratios in the table are rounded to six decimals.
    EXPECT_NEAR(fit["parameters"]["C"]["value"], 0.24, 1e-3);
    EXPECT_EQ(fit["plateau"], at_p_crit ? "p_crit" : "p");
  }
}

TEST(FitDynamicCompaction, TheBudgetAndTheFlaggedRowsAreSaid) {
  const std::string table = compacted_samples(false) + "2.5,1,9,100\n";
  const Outcome o = run_floc("fit dynamic-compaction - --format json", ".", table);
  ASSERT_EQ(o.code, 0) << o.err;
  const json fit = json::parse(o.out).at(0);
  EXPECT_EQ(fit["rows_left_out"]["beside_plateau"], json::array({16}));
  EXPECT_EQ(fit["n_points"], 16);
  EXPECT_EQ(fit["errors_from"], "residuals");
  EXPECT_TRUE(fit["error_budget"]["C"]["law"].is_null());
  EXPECT_GT(fit["error_budget"]["C"]["scatter"], 0.0);
  EXPECT_THAT(o.err, HasSubstr("1 of the 17 samples lie above the plateau of the law or at eta* > 1, and miss "
                               "the law by more than four standard deviations"));
  EXPECT_THAT(o.err,
              HasSubstr("rows that are not fitted because their void ratio does not lie on the plateau: 16"));
}

TEST(FitForceDistribution, FitsEveryFormOfATable) {
  std::string table = "normal_force\n";
  for (int k = 1; k < 100; ++k)
    table += std::to_string(-2 * std::log(k / 100.0)) + "\n" + std::to_string(0.5 * std::log(k / 100.0)) + "\n";
  const Outcome o = run_floc("fit force-distribution - --threshold 0 --draws 50 --format json", ".", table);
  ASSERT_EQ(o.code, 0) << o.err;
  const json fits = json::parse(o.out);
  ASSERT_EQ(fits.size(), 4u);
  std::vector<std::string> forms;
  for (const json& fit : fits) forms.push_back(fit["form"]);
  EXPECT_THAT(forms,
              ElementsAre("tail_positive", "tail_negative", "power_exponential", "quadratic_exponential"));
  // The forces are 99 quantiles of exponential distributions with means 2 and 0.5. The mean of the quantiles is
  // 2 % too small.
  EXPECT_NEAR(fits[0]["parameters"]["f_0"]["value"], 2.0, 0.06);
  EXPECT_NEAR(fits[1]["parameters"]["f_0"]["value"], 0.5, 0.015);
  // With beta = 1, the quadratic form is an exponential distribution.
  EXPECT_NEAR(fits[3]["parameters"]["beta"]["value"], 1.0, 0.1);
  for (const json& fit : fits) EXPECT_GT(fit["p_value"], 0.01) << fit["form"];
}

}  // namespace
}  // namespace floc::test
