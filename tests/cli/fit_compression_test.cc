#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Table of a tablet that follows Heckel's law exactly; pressures are in MPa.
std::string tablet() {
  std::string text = "p [MPa],D\n";
  for (double p = 5; p < 300; p += 15) text += fmt::format("{},{:.6f}\n", p, 1 - std::exp(-0.55 - p / 85));
  return text;
}

TEST(FitCompression, TheBestLawComesFirstWithItsUnits) {
  const Outcome o = run_floc("fit compression - --columns P=p,phi=D --format json", ".", tablet());
  ASSERT_EQ(o.code, 0) << o.err;
  const json fits = json::parse(o.out);
  ASSERT_EQ(fits.size(), 6u);
  EXPECT_EQ(fits[0]["law"], "heckel");
  EXPECT_NEAR(fits[0]["parameters"]["P_y"]["value"], 85.0, 1e-2);
  EXPECT_EQ(fits[0]["delta_aicc"], 0.0);
  EXPECT_EQ(fits[0]["density"], "out-of-die");
  for (std::size_t k = 1; k < fits.size(); ++k) EXPECT_GE(fits[k]["delta_aicc"], fits[k - 1]["delta_aicc"]);
  EXPECT_THAT(o.err, HasSubstr("AICc"));
  const Outcome one =
      run_floc("fit compression - --columns P=p,phi=D --law heckel --format csv", ".", tablet());
  EXPECT_THAT(one.out, HasSubstr("heckel,P_y,"));
  EXPECT_THAT(one.out, HasSubstr(",MPa,"));
}

TEST(FitCompression, InADieRowsAboveTheSolidAreReadWhereTheBoundIsLifted) {
  // Loading by Heckel's law plus an elastic strain, which raises the density above 1, and then unloading.
  std::string table = "p [MPa],D\n";
  for (const double p : {10, 40, 80, 120, 160, 200, 240, 280, 320, 240, 160, 80})
    table += fmt::format("{},{:.6f}\n", p, (p == 320 ? 1.0 : 0.99) - std::exp(-0.8 - p / 60.0) + p / 12000.0);
  const std::string compression = "fit compression - --columns P=p,phi=D --format json ";
  const Outcome refused = run_floc(compression, ".", table);
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, HasSubstr("measured in a die under load"));
  EXPECT_THAT(refused.err, HasSubstr("--phi-limit none"));
  for (const char* lifted : {"--density in-die", "--phi-limit none", "--phi-limit 1.1"}) {
    const Outcome o = run_floc(compression + lifted, ".", table);
    ASSERT_EQ(o.code, 0) << lifted << o.err;
    for (const json& fit : json::parse(o.out))
      if (fit["law"] == "walker") {  // the fit of Heckel's law uses only a part of the rows
        EXPECT_EQ(fit["rows_used"].back(), 8) << o.out;
      }
  }
  for (const char* command : {"fit consolidation - --columns P_star=p,phi=D", "fit cycle - --columns P=p,phi=D",
                              "fit elastic - --columns P=p,phi=D",
                              "fit preconsolidation - --columns P_star=p,phi=D --branch first"}) {
    EXPECT_EQ(run_floc(command, ".", table).code, 4) << command;
    const Outcome o = run_floc(std::string(command) + " --phi-limit none", ".", table);
    EXPECT_NE(o.code, 4) << command << o.err;
  }
  EXPECT_EQ(run_floc("fit cycle - --columns P=p,phi=D --phi-limit none", ".", "p,D\n1,62\n2,63\n1,62\n").code,
            4);
}

TEST(FitCompression, BadInputIsRefused) {
  EXPECT_EQ(run_floc("fit compression - --law cubic", ".", tablet()).code, 2);
  EXPECT_EQ(run_floc("fit compression - --columns P=p,phi=D --phi-limit much", ".", tablet()).code, 4);
  EXPECT_EQ(run_floc("fit compression -", ".", "P,phi\n1,0.5\n2,0.6\n").code, 3);
}

}  // namespace
}  // namespace floc::test
