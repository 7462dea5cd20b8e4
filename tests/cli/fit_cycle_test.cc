#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

Outcome fit_cycle(const std::string& table) {
  return run_floc("fit cycle - --format json", ScratchDirectory().path(), table);
}

TEST(FitCycle, PrintsWhatEachPressureKeeps) {
  const Outcome o = fit_cycle("branch,P [kPa],phi\nload,1,0.5\nload,3,0.625\nunload,1,0.55\n");
  ASSERT_EQ(o.code, 0) << o.err;
  const json rows = json::parse(o.out);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at("P"), 1.0);
  EXPECT_EQ(rows[0].at("phi_up"), 0.5);
  EXPECT_EQ(rows[0].at("phi_down"), 0.55);
  EXPECT_NEAR(rows[0].at("dphi_irr").get<double>(), 0.05, 1e-15);
  EXPECT_EQ(rows[0].at("P_turn"), 3.0);
  // The work is minus the integral of P d(1/Phi). The contributions of loading and unloading add up to 2 (1/0.5 -
  // 1/0.55).
  EXPECT_NEAR(rows[0].at("work").get<double>(), 2.0 * (2.0 - 1.0 / 0.55), 1e-14);
  EXPECT_EQ(rows[0].at("unit"), "kPa");
}

TEST(FitCycle, OfALoadingAloneIsRefusedInWords) {
  const Outcome o = fit_cycle("P_star,phi\n1,0.5\n3,0.6\n");
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(
      o.err,
      HasSubstr("the load path contains no pressure cycle: no pressure is reached both on loading and on the "
                "unloading"));
}

}  // namespace
}  // namespace floc::test
