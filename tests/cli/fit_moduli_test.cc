#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// A table of moduli of two samples that are loaded and unloaded. On loading, the moduli are exact powers of the
/// pressure.
std::string powers() {
  std::string text = "file,P [kPa],phi,B [MPa],G [MPa]\n";
  for (const double exponent : {0.3, 0.5})
    for (int k = 0; k <= 12; ++k) {
      const double P = 10.0 * std::pow(10.0, 0.25 * std::min(k, 16 - k)),
                   phi = 0.6 + 0.01 * std::min(k, 16 - k);
      const double unloaded = k > 8 ? 1.3 : 1.0;
      text += fmt::format("run-{}/state-{:04}.h5,{},{},{},{}\n", exponent, k, P, phi,
                          unloaded * 20.0 * std::pow(P, exponent), unloaded * 900.0 * std::pow(phi - 0.55, 2));
    }
  return text;
}

TEST(FitModuli, OfTheFirstLoadingOfEachSampleAndTheirMean) {
  const Outcome o = run_floc("fit moduli - --format json", ".", powers());
  ASSERT_EQ(o.code, 0) << o.err;
  const json fits = json::parse(o.out);
  ASSERT_EQ(fits.size(), 12u);  // (two samples and their mean) * two moduli * two quantities
  EXPECT_EQ(fits[0]["sample"], "run-0.3");
  EXPECT_EQ(fits[0]["modulus"], "B");
  EXPECT_EQ(fits[0]["against"], "P");
  EXPECT_EQ(fits[0]["unit"], "MPa");
  EXPECT_EQ(fits[0]["n_points"], 9);
  EXPECT_NEAR(fits[0]["parameters"]["exponent"]["value"].get<double>(), 0.3, 1e-5);
  EXPECT_NEAR(fits[0]["parameters"]["coefficient"]["value"].get<double>(), 20.0, 1e-3);
  EXPECT_EQ(fits[3]["modulus"], "G");
  EXPECT_EQ(fits[3]["against"], "phi");
  EXPECT_NEAR(fits[3]["parameters"]["exponent"]["value"].get<double>(), 2.0, 1e-3);
  EXPECT_NEAR(fits[3]["parameters"]["phi_0"]["value"].get<double>(), 0.55, 1e-4);
  EXPECT_EQ(fits[8]["sample"], "pooled");
  EXPECT_NEAR(fits[8]["parameters"]["exponent"]["value"].get<double>(), 0.4, 1e-5);
  EXPECT_THAT(o.err, HasSubstr("run-0.3: only the 9 rows of the first loading are fitted, of 13 rows in all"));
}

TEST(FitModuli, OfNamedColumnsWithAllStates) {
  const Outcome o = run_floc("fit moduli - --moduli Gmax --branch all --columns P=p0 --format csv", ".",
                             "p0 [kPa];Gmax [MPa]\n100;50\n25;25\n400;100\n50;35,355339\n");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("stdin,Gmax,P,exponent,0.5"));
}

TEST(FitModuli, LeaveOutColumnsWithoutValues) {
  std::string text = "P,B,G_shear,M\n";
  for (const double P : {1.0, 2.0, 4.0, 8.0, 16.0}) text += fmt::format("{},{},,\n", P, std::sqrt(P));
  const Outcome o = run_floc("fit moduli - --format csv", ".", text);
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("stdin,B,P,exponent,"));
  EXPECT_THAT(o.err, Not(HasSubstr("G_shear")));
  EXPECT_EQ(run_floc("fit moduli - --moduli G_shear", ".", text).code, 3);
}

TEST(FitModuli, ThatATableDoesNotHaveAreRefused) {
  const Outcome o = run_floc("fit moduli -", ".", "P,phi\n1,0.5\n2,0.6\n");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("none of the columns B, B_S, G, G_shear, M, E"));
  const Outcome few = run_floc("fit moduli -", ".", "P,B\n1,5\n2,6\n");
  EXPECT_EQ(few.code, 3);
  EXPECT_THAT(few.err, HasSubstr("there are 2 states"));
}

}  // namespace
}  // namespace floc::test
