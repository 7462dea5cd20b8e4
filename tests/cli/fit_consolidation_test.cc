#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "floc/fitting/consolidation_law.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Published parameters lambda, alpha and Phi_max [GRC2008], and P1*, which is computed from these parameters. Regime I
/// ends at P0* = 10^(-13/8).
const ConsolidationLawParameters kLaw{0.349, 0.91, 0.7808, 0.27};
const double kP0 = std::pow(10.0, -13.0 / 8);

/// Table of a path that follows kLaw: a row at P* = 0, a row of the assembly, the loading and the unloading. In the
/// loading, each pressure is 10^(1/8) times the previous one.
/// @param shift  added to every 1/Phi
std::string path_table(double shift = 0.0) {
  std::string text = "step,branch,P_star,phi\n0,assembly,0,0.45\n";
  for (int k = 0; k <= 25; ++k) {
    const double P = 0.01 * std::pow(10.0, k / 8.0);
    const double y = kLaw.inverse_phi(std::max(P, kP0)) + shift;
    text += fmt::format("{},{},{},{}\n", k + 1, k == 0 ? "assembly" : "load", P, 1 / y);
  }
  return text + "27,unload,1,0.77\n28,unload,0.01,0.76\n";
}

TEST(FitConsolidation, RecoversTheLawBehindATableAndSaysWhichRowsItUsed) {
  const Outcome o = run_floc("fit consolidation - --format json", ".", path_table());
  ASSERT_EQ(o.code, 0) << o.err;
  const json fit = json::parse(o.out).at(0);
  EXPECT_NEAR(fit["parameters"]["lambda"]["value"], kLaw.lambda, 1e-8);
  EXPECT_NEAR(fit["parameters"]["alpha"]["value"], kLaw.alpha, 1e-8);
  EXPECT_NEAR(fit["parameters"]["Phi_max"]["value"], kLaw.phi_max, 1e-8);
  EXPECT_NEAR(fit["parameters"]["P1_star"]["value"], kLaw.P1_star, 1e-8);
  for (const char* key : {"law", "window", "n_points", "correlation", "rms", "rows_used", "warnings"})
    EXPECT_TRUE(fit.contains(key)) << key;
  for (const char* key : {"value", "stderr", "low95", "high95", "identified"})
    EXPECT_TRUE(fit["parameters"]["lambda"].contains(key)) << key;
  EXPECT_EQ(fit["rows_used"].size(), fit["n_points"]);
  // Row 26 is the last row of the loading. Rows of the unloading are not fitted.
  EXPECT_EQ(fit["rows_used"].back(), 26);
  EXPECT_THAT(o.err, HasSubstr("rows that are not fitted: 1 row(s) at P* = 0 (row numbers 0), 2 row(s) of "
                               "unloading (row numbers 27-28)"));
  EXPECT_THAT(o.err, HasSubstr("plateau of regime I"));
  EXPECT_THAT(o.err, HasSubstr("r.m.s. residual of 1/Phi"));
}

TEST(FitConsolidation, AnEnsembleIsFittedSampleBySampleAndPooled) {
  const ScratchDirectory dir;
  for (const auto& [seed, shift] : {std::pair{"seed-2", 0.01}, {"seed-10", -0.01}}) {
    std::filesystem::create_directories(dir.file(seed));
    write_text(dir.file(seed) + "/path.csv", path_table(shift));
  }
  const Outcome o = run_floc("fit consolidation . --format json", dir.path());
  ASSERT_EQ(o.code, 0) << o.err;
  const json fits = json::parse(o.out);
  ASSERT_EQ(fits.size(), 3u);
  EXPECT_THAT(fits[0]["sample"], HasSubstr("seed-2/"));
  EXPECT_THAT(fits[1]["sample"], HasSubstr("seed-10/"));
  EXPECT_EQ(fits[2]["sample"], "pooled");
  // The shifts of 1/Phi in the samples have a mean of zero. Phi_max is therefore exact for the mean of the samples,
  // although it is shifted in the fit of each single sample.
  EXPECT_NEAR(fits[2]["parameters"]["Phi_max"]["value"], kLaw.phi_max, 1e-8);
  EXPECT_NEAR(fits[0]["parameters"]["Phi_max"]["value"], 1 / (1 / kLaw.phi_max + 0.01), 1e-8);
  for (const json& fit : fits) EXPECT_NEAR(fit["parameters"]["lambda"]["value"], kLaw.lambda, 1e-8);
}

TEST(FitConsolidation, PublishedProtocolHoldsP0OnTheGridAndKeepsTheIdentity) {
  const Outcome o = run_floc("fit consolidation - --protocol published --window 0.0237,13.4 --format json", ".",
                             path_table());
  ASSERT_EQ(o.code, 0) << o.err;
  const json p = json::parse(o.out).at(0)["parameters"];
  EXPECT_NEAR(p["P0_star"]["value"], kP0, 1e-12);
  EXPECT_TRUE(p["P0_star"]["stderr"].is_null());
  const auto value = [&](const char* name) { return p[name]["value"].get<double>(); };
  EXPECT_NEAR(std::log(value("P1_star") / value("P0_star")),
              (1 / value("Phi0") - 1 / value("Phi_max")) / value("lambda"), 1e-10);
}

/// Table of a natural clay. The void ratio decreases by 0.035 per unit of ln p below 170 kPa, and by 0.22 per unit
/// above 170 kPa.
std::string natural_clay() {
  std::string text = "p,e\n";
  for (double p = 6; p < 4000; p *= 2) {
    const double x = std::log(p / 170.0);
    text += fmt::format("{},{:.5f}\n", p, 1.183 - (x < 0 ? 0.035 : 0.22) * x);
  }
  return text;
}

TEST(FitConsolidation, LeadsWithTheVirginLineOfASoilAndItsYield) {
  const Outcome o =
      run_floc("fit consolidation - --columns P_star=p,void_ratio=e --format json", ".", natural_clay());
  ASSERT_EQ(o.code, 0) << o.err;
  const json fit = json::parse(o.out).at(0);
  EXPECT_EQ(fit["law"], "log");
  EXPECT_EQ(fit["law_asked"], "auto");
  const auto value = [&](const char* name) { return fit["parameters"][name]["value"].get<double>(); };
  EXPECT_NEAR(value("lambda"), 0.22, 1e-4);
  EXPECT_NEAR(value("kappa"), 0.035, 1e-4);
  EXPECT_NEAR(value("P0_star"), 170.0, 0.1);
  EXPECT_NEAR(value("C_c"), std::log(10.0) * 0.22, 3e-4);
  EXPECT_THAT(o.err, HasSubstr("yield pressure P0* = 170"));
  EXPECT_THAT(o.err, HasSubstr("if the window moves by a row"));
  // The plateau of the full law is horizontal, but the recompression line of a clay has a slope. The command warns
  // about this.
  const Outcome full = run_floc("fit consolidation - --law full --columns P_star=p,void_ratio=e --format json",
                                ".", natural_clay());
  EXPECT_THAT(full.err, HasSubstr("the plateau of regime I is not level"));
}

TEST(FitConsolidation, TheSolidFractionTendsToOneAtMost) {
  std::string tablet = "p,D\n";
  for (double p = 2; p < 430; p = p < 10 ? p + 4 : p + 10)
    tablet += fmt::format("{},{:.6f}\n", p, 1 - std::exp(-0.55 - p / 85));
  const std::string command = "fit consolidation - --law full --columns P_star=p,phi=D --format json";
  const json bounded = json::parse(run_floc(command, ".", tablet).out).at(0);
  EXPECT_TRUE(bounded["parameters"]["Phi_max"]["value"].is_null());
  EXPECT_EQ(bounded["parameters"]["Phi_max"]["high95"], 1.0);
  EXPECT_TRUE(bounded["residual_pattern"]["systematic"]);
  const json open = json::parse(run_floc(command + " --phi-limit none", ".", tablet).out).at(0);
  EXPECT_GT(open["parameters"]["Phi_max"]["value"], 1.0);
  const Outcome bad = run_floc(command + " --phi-limit much", ".", tablet);
  EXPECT_EQ(bad.code, 4);
  EXPECT_THAT(bad.err, HasSubstr("--phi-limit"));
}

TEST(FitConsolidation, TheTableShowsLambdaWithItsError) {
  const Outcome o = run_floc("fit consolidation - --format table", ".", path_table());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("stderr"));
  EXPECT_THAT(o.out, HasSubstr("lambda"));
  EXPECT_THAT(o.out, HasSubstr("0.349"));
}

TEST(FitConsolidation, TooFewPressuresAreRefusedInWords) {
  const Outcome o =
      run_floc("fit consolidation - --law log --window 0.03,0.05 --format csv", ".", path_table());
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err, HasSubstr("there are 2 pressures in regime II, but a fit of the log law needs 3"));
  EXPECT_THAT(o.out, Not(HasSubstr("lambda")));
}

TEST(FitConsolidation, ATableMayFollowAnOptionWithTwoNumbers) {
  const auto fit = [](const std::string& arguments) {
    const Outcome o = run_floc("fit consolidation " + arguments + " --law log --format csv", ".", path_table());
    EXPECT_EQ(o.code, 0) << arguments << o.err;
    return o.out;
  };
  const std::string before = fit("- --window 0.0237,13.4");
  EXPECT_EQ(fit("--window 0.0237,13.4 -"), before);
  EXPECT_EQ(fit("--window 0.0237 13.4 -"), before);
}

TEST(FitConsolidation, BadTablesAreNamedAndTheOthersStillDone) {
  const ScratchDirectory dir;
  write_text(dir.file("good.csv"), path_table());
  write_text(dir.file("text.csv"), "P_star,phi\n0.1,0.5\n0.2,dense\n");
  write_text(dir.file("column.csv"), "load,phi\n0.1,0.5\n");
  write_text(dir.file("negative.csv"), "P_star,phi\n-0.1,0.5\n");
  write_text(dir.file("falls.csv"), "branch,P_star,phi\nload,0.2,0.5\nload,0.1,0.5\n");
  const Outcome o = run_floc(
      "fit consolidation missing.csv text.csv column.csv negative.csv falls.csv good.csv --format json",
      dir.path());
  EXPECT_EQ(o.code, 4);
  EXPECT_EQ(json::parse(o.out).size(), 1u);
  EXPECT_THAT(o.err, HasSubstr("missing.csv"));
  EXPECT_THAT(o.err, HasSubstr("text.csv:3"));
  EXPECT_THAT(o.err, HasSubstr("column.csv"));
  EXPECT_THAT(o.err, HasSubstr("negative.csv:2: P_star = -0.1: expected a pressure >= 0"));
  EXPECT_THAT(o.err, HasSubstr("falls.csv:3"));
}

TEST(FitConsolidation, BadOptionsAreBadUsageOrBadInput) {
  EXPECT_EQ(run_floc("fit consolidation").code, 2);
  EXPECT_EQ(run_floc("fit consolidation - --law cubic").code, 2);
  EXPECT_EQ(run_floc("fit consolidation - --window 2,1").code, 4);
  EXPECT_EQ(run_floc("fit consolidation - --law log --protocol published").code, 4);
}

}  // namespace
}  // namespace floc::test
