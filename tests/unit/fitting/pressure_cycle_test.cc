#include "floc/fitting/pressure_cycle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace floc {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Cycle with 1/Phi = 2 - 0.01 P on loading up to P = 8, and 1/Phi = 1.96 - 0.005 P on unloading.
std::vector<PathRow> straight_cycle() {
  std::vector<PathRow> rows;
  for (const double P : {1.0, 2.0, 4.0, 8.0}) rows.push_back({"load", P, 1.0 / (2.0 - 0.01 * P)});
  for (const double P : {4.0, 2.0, 1.0}) rows.push_back({"unload", P, 1.0 / (1.96 - 0.005 * P)});
  return rows;
}

TEST(PressureCycle, OfStraightLinesEnclosesItsTriangle) {
  const std::vector<PressureCycle> cycles = pressure_cycles(straight_cycle());
  ASSERT_THAT(cycles, SizeIs(1));
  const PressureCycle& c = cycles[0];
  EXPECT_THAT(c.up.rows, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(c.down.rows, ElementsAre(3, 4, 5, 6));
  ASSERT_THAT(c.P, ElementsAre(1.0, 2.0, 4.0));
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(c.phi_up[k], 1.0 / (2.0 - 0.01 * c.P[k]), 1e-15);
    EXPECT_NEAR(c.phi_down[k], 1.0 / (1.96 - 0.005 * c.P[k]), 1e-15);
  }
  // The work is the integral from P = 1 to 8 of the difference of the two branches, 0.04 - 0.005 P, minus the term 1 *
  // (1.955 - 1.99) at P = 1.
  EXPECT_NEAR(c.work.value(), 0.04 * 7.0 - 0.0025 * 63.0 + 0.035, 1e-14);
}

TEST(PressureCycle, ThatIsReversibleTakesNoWork) {
  std::vector<PathRow> rows;
  for (int k = 0; k <= 10; ++k) rows.push_back({"", std::pow(10.0, 0.5 * k), 0.6 + 0.01 * k});
  for (int k = 9; k >= 0; --k) rows.push_back({"", std::pow(10.0, 0.5 * k), 0.6 + 0.01 * k});
  const PressureCycle c = pressure_cycles(rows).at(0);
  EXPECT_THAT(c.P, SizeIs(10));
  EXPECT_EQ(c.phi_up, c.phi_down);
  EXPECT_NEAR(c.work.value(), 0.0, 1e-10);
  EXPECT_GT(work_of_path(c.up.curve), 100.0);
}

TEST(PressureCycle, OfPowerLawsConvergesToTheirIntegral) {
  // On loading 1/Phi = 2 - 0.1 P^(2/3), on unloading 1/Phi = 2 - 0.1 P, between P0 = 0.01 and 1.
  for (const int n : {20, 80}) {
    std::vector<PathRow> rows;
    for (int k = 0; k <= n; ++k) {
      const double P = std::pow(100.0, static_cast<double>(k) / n - 1.0);
      rows.push_back({"", P, 1.0 / (2.0 - 0.1 * std::pow(P, 2.0 / 3.0))});
    }
    for (int k = n - 1; k >= 0; --k) rows.push_back({"", rows[k].P_star, 1.0 / (2.0 - 0.1 * rows[k].P_star)});
    const double P0 = 0.01, p = 5.0 / 3.0;
    const double area = 0.1 * ((1.0 - P0 * P0) / 2.0 - (1.0 - std::pow(P0, p)) / p);
    const double ends = P0 * 0.1 * (std::pow(P0, 2.0 / 3.0) - P0);
    // The error of the trapezoidal rule is proportional to the square of the step.
    EXPECT_NEAR(pressure_cycles(rows).at(0).work.value(), area - ends, 0.05 / (n * n)) << n;
  }
}

TEST(PressureCycle, IsFoundInEachPartOfAPath) {
  std::vector<PathRow> rows = straight_cycle();
  rows.insert(rows.begin(), {"assembly", 0.0, 0.4});
  // the branch `hold` adds a second row at P = 4; the Phi of this row is used for P = 4
  rows.insert(rows.begin() + 4, {"hold", 4.0, rows[3].phi + 0.01});
  rows.push_back({"reload", 2.0, 0.52});
  rows.push_back({"reload", 16.0, 0.6});
  rows.push_back({"unload", 8.0, 0.59});
  rows.push_back({"unload", 2.0, 0.55});
  const std::vector<PressureCycle> cycles = pressure_cycles(rows);
  ASSERT_THAT(cycles, SizeIs(2));
  EXPECT_THAT(cycles[0].up.rows, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(cycles[0].phi_up[2], rows[4].phi);
  EXPECT_EQ(cycles[0].phi_down[2], rows[6].phi);
  EXPECT_THAT(cycles[1].up.rows, ElementsAre(8, 9, 10));
  EXPECT_THAT(cycles[1].P, ElementsAre(2.0));
  EXPECT_EQ(cycles[1].phi_up[0], 0.52);
  EXPECT_EQ(cycles[1].phi_down[0], 0.55);
}

TEST(PressureCycle, NeedsALoadingAndAnUnloading) {
  EXPECT_THAT(pressure_cycles({}), IsEmpty());
  EXPECT_THAT(pressure_cycles({{"", 1.0, 0.5}, {"", 2.0, 0.6}}), IsEmpty());
  EXPECT_THAT(pressure_cycles({{"", 2.0, 0.6}, {"", 1.0, 0.5}}), IsEmpty());
  // The two branches have no pressure in common.
  const auto apart = pressure_cycles({{"", 1.0, 0.5}, {"", 3.0, 0.6}, {"", 2.0, 0.59}});
  ASSERT_THAT(apart, SizeIs(1));
  EXPECT_FALSE(apart[0].work);
}

}  // namespace
}  // namespace floc
