#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/run_arguments.h"

namespace floc::test {
namespace {

using nlohmann::json;

Outcome chain(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "chain");
  return floc_arguments(arguments);
}

TEST(ChainCommand, PrintsBothDefinitionsWithTheSolvedNetworkBesideThem) {
  const Outcome o =
      chain({"--n", "20", "--R", "0.5", "--kn", "1", "--kt", "1", "--kr", "1e-4", "--format", "json"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  const json rows = json::parse(o.out);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[1].at("compliance"), "transverse");
  EXPECT_EQ(rows[3].at("compliance"), "end_disk_deflection");
  // Compliances of a chain of n disks with radius R. Between the ends, the compliance is (n-1)/K_T + n (n-1)(n-2)
  // R^2/(3 K_R). For the end disk, n (n-1)(n-2) is replaced by (n-1)(4 n^2 - 11 n + 6) (see `floc chain`).
  EXPECT_NEAR(rows[1].at("formula").get<double>(), 19.0 + 20.0 * 19.0 * 18.0 * 0.25 / 3e-4, 1e-8);
  EXPECT_NEAR(rows[3].at("formula").get<double>(), 19.0 + 19.0 * (1600.0 - 220.0 + 6.0) * 0.25 / 3e-4, 1e-7);
  for (const json& row : rows) {
    const double error = std::abs(row.at("solved").get<double>() - row.at("formula").get<double>());
    EXPECT_LE(error, row.at("error_bound").get<double>()) << row.at("compliance");
  }
}

TEST(ChainCommand, OfABentChainGivesTheSolvedNetworkAlone) {
  const Outcome o = chain(
      {"--n", "20", "--R", "0.5", "--kn", "1", "--kt", "1", "--kr", "1e-4", "--bend", "2", "--format", "json"});
  ASSERT_EQ(o.code, 0) << o.err;
  for (const json& row : json::parse(o.out)) {
    EXPECT_TRUE(row.at("formula").is_null());
    EXPECT_TRUE(row.at("solved").is_number());
  }
}

TEST(ChainCommand, SaysWhereNoDigitIsLeft) {
  const Outcome o =
      chain({"--n", "2000", "--R", "1", "--kn", "1", "--kt", "1", "--kr", "1e-28", "--format", "json"});
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(o.err, testing::HasSubstr("compliance transverse: rounding in double precision leaves no correct "
                                        "digit in the solution of the contact network"));
  EXPECT_TRUE(json::parse(o.out)[1].at("solved").is_null());
}

TEST(ChainCommand, RefusesWhatIsNoChain) {
  EXPECT_EQ(chain({"--n", "5"}).code, 2);
  const Outcome o = chain({"--n", "5", "--R", "1", "--kn", "1", "--kt", "1", "--kr", "-1"});
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, testing::HasSubstr("K_R = -1: must be > 0"));
  EXPECT_EQ(chain({"--n", "1", "--R", "1", "--kn", "1", "--kt", "1", "--kr", "1"}).code, 4);
}

}  // namespace
}  // namespace floc::test
