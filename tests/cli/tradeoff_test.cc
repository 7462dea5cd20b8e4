#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace floc::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A scene so small that a sample takes a fraction of a second.
const std::string kSmall = std::string(FLOC_SOURCE_DIR) +
                           "/data/scenes/type1_rolling_small.toml --set grains.count=40 --set load.0.to=0.1 "
                           "--set load.0.steps_per_decade=2 ";

TEST(TradeoffCommand, MeasuresEverySettingAgainstTheStrictest) {
  const ScratchDirectory scratch;
  const Outcome o =
      run_floc("tradeoff " + kSmall + "--samples 2 --budget 60 --format json --plot t.svg", scratch.path());
  ASSERT_EQ(o.code, 0) << o.err;
  bool strict = false, bounds = false;
  for (const auto& row : nlohmann::json::parse(o.out)) {
    EXPECT_GT(row["core_seconds"], 0.0);
    if (row["knob"] == "strict" && row["observable"] == "phi") {
      strict = true;
      EXPECT_EQ(row["cost_ratio"], 1.0);
      EXPECT_EQ(row["error_before"], 0.0);
      EXPECT_EQ(row["mean_difference"], 0.0);
      EXPECT_EQ(row["n_samples"], 2);
      EXPECT_EQ(row["tolerance"], 1e-8);
    }
    if (row["knob"] == "moduli" && row["value"] == "bounds" && row["observable"] == "B") {
      bounds = true;
      EXPECT_GT(row["error_before"], 0.01);
    }
    if (row["knob"] == "moduli" && row["value"] == "factor 1e-10" && row["observable"] == "B") {
      EXPECT_LT(row["error_before_high"], 1e-10);
    }
  }
  EXPECT_TRUE(strict);
  EXPECT_TRUE(bounds);
  EXPECT_THAT(o.err, HasSubstr("the force loop has double precision only"));
  for (const char* file : {"t.svg", "t.dat", "t.gp"})
    EXPECT_TRUE(std::filesystem::exists(scratch.file(file))) << file;
}

TEST(TradeoffCommand, FirstColumnIsTheKnobAndObservablesCanBeChosen) {
  const Outcome o = run_floc("tradeoff " + kSmall + "--samples 1 --budget 60 --observables phi,B --format csv");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out, StartsWith("knob,value,observable,"));
  EXPECT_THAT(o.out, HasSubstr("\nstrict,all,phi,"));
  EXPECT_THAT(o.out, testing::Not(HasSubstr(",z_plus,")));
}

TEST(TradeoffCommand, SaysWhatABudgetDidNotAllow) {
  const Outcome o =
      run_floc("tradeoff " + std::string(FLOC_SOURCE_DIR) + "/data/scenes/demo.toml --budget 0.2 --format csv");
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err, HasSubstr("broken off at the end of the budget"));
  EXPECT_THAT(o.err, HasSubstr("--budget may be too small"));
}

TEST(TradeoffCommand, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(run_floc("tradeoff " + kSmall + "--observables colour").code, 2);
  EXPECT_EQ(run_floc("tradeoff " + kSmall + "--budget 0").code, 2);
  const Outcome o = run_floc("tradeoff nowhere.toml");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("nowhere.toml: cannot be read"));
}

TEST(AccuracyOfARun, IsSaidAndKeptWithTheStates) {
  const ScratchDirectory scratch;
  const std::string scene = kSmall + "--set accuracy.phi=0.01 --set accuracy.moduli=0.05 ";
  const Outcome check = run_floc("scene check " + scene);
  ASSERT_EQ(check.code, 0) << check.err;
  EXPECT_THAT(check.err, HasSubstr("accuracy: "));
  EXPECT_THAT(check.err, HasSubstr("of the cost of the strictest settings. Measured errors: phi "));
  const Outcome run = run_floc("run " + scene + "-o out --until 0", scratch.path());
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("accuracy: "));
  const Outcome text = run_floc("info out/state-0000.h5 --scene", scratch.path());
  EXPECT_THAT(text.out, HasSubstr("chosen = "));
  EXPECT_THAT(text.out, HasSubstr("time_step = "));
  EXPECT_EQ(run_floc("run " + scene + "-o out --until 1 --resume", scratch.path()).code, 0);
}

TEST(AccuracyOfARun, IsRefusedBeyondTheTable) {
  const Outcome o = run_floc("scene check " + kSmall + "--set accuracy.phi=1e-14");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("expected at least"));
}

TEST(ModuliMethods, CheaperOnesLeaveOutWhatTheyDoNotTell) {
  const ScratchDirectory scratch;
  ASSERT_EQ(run_floc("run " + kSmall + "-o out", scratch.path()).code, 0);
  const auto rows = [&](const std::string& method) {
    const Outcome o = run_floc("moduli out/state-*.h5 --format json --method " + method, scratch.path());
    EXPECT_EQ(o.code, 0) << o.err;
    return nlohmann::json::parse(o.out);
  };
  const auto exact = rows("factor"), single = rows("single-factor --tolerance 1e-6"), bounds = rows("bounds"),
             iterative = rows("iterative --tolerance 1e-3");
  for (std::size_t k = 0; k < exact.size(); ++k) {
    for (const auto& other : {single, bounds, iterative})
      EXPECT_LE(std::abs(double(other[k]["B"]) - double(exact[k]["B"])),
                double(other[k]["error_B"]) + double(exact[k]["error_B"]))
          << k;
    EXPECT_TRUE(single[k]["n_negative"].is_null());
    EXPECT_TRUE(bounds[k]["C11"].is_null());
    EXPECT_FALSE(exact[k]["n_negative"].is_null());
  }
  const Outcome o = run_floc("moduli out/state-0000.h5 --method bounds --increments i.csv", scratch.path());
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("expects --method factor"));
}

}  // namespace
}  // namespace floc::test
