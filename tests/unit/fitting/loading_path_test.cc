#include "floc/fitting/loading_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floc {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(FirstLoading, TakesAssemblyAndTheFirstRunOfLoadRowsOnly) {
  const std::vector<PathRow> rows = {{"assembly", 0.0, 0.4}, {"assembly", 0.01, 0.45}, {"load", 0.1, 0.5},
                                     {"load", 1.0, 0.6},     {"unload", 0.1, 0.59},    {"load", 2.0, 0.65}};
  EXPECT_THAT(first_loading(rows).rows, ElementsAre(1, 2, 3));
  EXPECT_THAT(first_loading(rows, true).rows, ElementsAre(1, 2, 3, 5));
}

TEST(FirstLoading, WithoutBranchesGoesUpToTheFirstFallOfPressure) {
  const std::vector<PathRow> rows = {{"", 0.1, 0.4}, {"", 0.2, 0.5}, {"", 0.1, 0.5}, {"", 0.4, 0.6}};
  EXPECT_THAT(first_loading(rows).rows, ElementsAre(0, 1));
  EXPECT_THAT(first_loading(rows, true).rows, ElementsAre(0, 1, 3));
}

TEST(PathSteps, ALoopIsUnloadingReloadingAndThenVirginAgain) {
  using enum PathStep;
  std::vector<PathRow> rows;
  for (const double P : {0.0, 1.0, 4.0, 2.0, 1.0, 2.0, 4.0, 8.0, 8.0, 3.0, 0.0}) rows.push_back({"", P, 0.5});
  EXPECT_THAT(path_steps(rows),
              ElementsAre(zero_pressure, first_loading, first_loading, unloading, unloading, reloading,
                          reloading, hold, later_virgin, unloading, zero_pressure));
}

/// A table of an oedometer test may have two rows at each pressure: one right after loading and one after creep. Only
/// the last row at a pressure is fitted.
TEST(PathSteps, OfSuccessiveRowsOfOnePressureTheLastCounts) {
  using enum PathStep;
  std::vector<PathRow> rows;
  double phi = 0.5;
  for (const double P : {1.0, 1.0, 2.0, 2.0, 2.0, 1.0, 1.0, 3.0, 3.0, 3.0})
    rows.push_back({"", P, phi += 0.01});
  EXPECT_THAT(path_steps(rows), ElementsAre(hold, first_loading, hold, hold, first_loading, hold, unloading,
                                            hold, hold, later_virgin));
  EXPECT_THAT(superseded_rows(rows), ElementsAre(0, 2, 3, 5, 7, 8));
  EXPECT_EQ(count_reversals(rows), 2);
  EXPECT_THAT(floc::first_loading(rows, true).rows, ElementsAre(1, 4, 9));
  ASSERT_EQ(unloadings(rows).size(), 1u);
  EXPECT_THAT(unloadings(rows)[0].rows, ElementsAre(4, 6));
  ASSERT_EQ(reloadings(rows).size(), 1u);
  EXPECT_THAT(reloadings(rows)[0].loading.rows, ElementsAre(6, 9));
  EXPECT_EQ(reloadings(rows)[0].largest_before, 2.0);
}

/// A branch that only keeps the last pressure of the previous branch adds no points to the curve, not even its last
/// row.
TEST(PathSteps, ABranchThatHoldsThePressureIsLeftOut) {
  using enum PathStep;
  const std::vector<PathRow> rows = {
      {"load", 1, 0.5}, {"load", 2, 0.6}, {"hold", 2, 0.61}, {"hold", 2, 0.62}, {"load", 4, 0.7}};
  EXPECT_THAT(path_steps(rows), ElementsAre(first_loading, first_loading, hold, hold, first_loading));
  EXPECT_THAT(superseded_rows(rows), IsEmpty());
}

TEST(PathFault, PressuresOfABranchKeepTheirDirection) {
  const auto fault = [](const std::vector<double>& P, const char* branch) {
    std::vector<PathRow> rows;
    for (const double p : P) rows.push_back({branch, p, 0.5});
    return path_fault(rows);
  };
  EXPECT_FALSE(fault({1, 2, 3}, "load"));
  EXPECT_FALSE(fault({3, 2, 1}, "unload"));
  EXPECT_FALSE(fault({1, 1, 1}, "hold"));
  EXPECT_FALSE(fault({1, 2, 1, 3}, ""));
  EXPECT_FALSE(fault({1, 2, 2}, "load"));
  EXPECT_FALSE(fault({1, 2, 2}, ""));
  EXPECT_EQ(fault({1, 2, 2, 1.5}, "load")->row, 3);
  EXPECT_EQ(fault({1, 1, 0.5}, "load")->row, 2);
  EXPECT_EQ(fault({3, 2, 2.5}, "unload")->row, 2);
  EXPECT_EQ(fault({1, 2, 1}, "press")->row, 2);
  EXPECT_EQ(fault({2, 2, 1, 2}, "press")->row, 3);
  EXPECT_THAT(fault({2, 1}, "load")->expected, HasSubstr("grows"));
  EXPECT_THAT(fault({1, 2}, "unload")->expected, HasSubstr("falls"));
}

TEST(MeanCurve, IsTheMeanOfInversePhiAtCommonPressures) {
  const auto mean =
      mean_curve({{{0.1, 1.0, 2.0}, {0.5, 0.6, 0.7}, {}}, {{0.1 * (1 + 1e-5), 2.0}, {0.4, 0.8}, {}}});
  EXPECT_THAT(mean.P_star, ElementsAre(0.1, 2.0));
  EXPECT_NEAR(1 / mean.phi[0], (1 / 0.5 + 1 / 0.4) / 2, 1e-15);
  EXPECT_NEAR(1 / mean.phi[1], (1 / 0.7 + 1 / 0.8) / 2, 1e-15);
  ASSERT_EQ(mean.samples.rows(), 2);
  ASSERT_EQ(mean.samples.cols(), 2);
  EXPECT_EQ(mean.samples(0, 1), 1 / 0.4);
  EXPECT_EQ(mean.samples(1, 0), 1 / 0.7);
  EXPECT_THAT(mean_curve({}).P_star, IsEmpty());
}

/// In tests with a driven axis, the stress on an axis of prescribed length may decrease along a branch. Among these
/// tests, only oedometer tests are consolidations.
TEST(LoadingPath, TestsWithADrivenAxisAreLeftOut) {
  const std::vector<PathRow> rows = {{"assembly", 1.0, 0.5},
                                     {"load", 2.0, 0.6, PathLoad::oedometric},
                                     {"load", 1.9, 0.61, PathLoad::oedometric},
                                     {"triaxial", 3.0, 0.7, PathLoad::other},
                                     {"triaxial", 2.5, 0.69, PathLoad::other},
                                     {"load", 4.0, 0.8}};
  EXPECT_FALSE(path_fault(rows));
  const std::vector<PathStep> steps = path_steps(rows);
  EXPECT_EQ(steps[1], PathStep::first_loading);
  EXPECT_EQ(steps[3], PathStep::test);
  EXPECT_EQ(steps[4], PathStep::test);
  EXPECT_EQ(steps[5], PathStep::later_virgin);
  EXPECT_EQ(first_loading(rows).rows, (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace floc
