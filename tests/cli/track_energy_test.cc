#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/io/csv.h"
#include "support/kill_and_resume.h"
#include "support/places.h"
#include "support/run_arguments.h"

namespace floc::test {
namespace {

using ::testing::HasSubstr;

const char* const kRun =
    "run small.toml --set equilibrium.finish=\"\\\"dynamic\\\"\" --until 1 --track-energy -o ";

/// A short run of which the account is kept.
class TrackEnergy : public ::testing::Test {
 protected:
  void SetUp() override { write_text(scratch_.file("small.toml"), small_scene()); }
  std::string file(const std::string& name) const { return scratch_.file(name); }
  Outcome floc(const std::string& arguments) const { return run_floc(arguments, scratch_.path()); }

  ScratchDirectory scratch_;
};

TEST_F(TrackEnergy, ClosesAndLosesNoEnergyTwice) {
  ASSERT_EQ(floc(std::string(kRun) + "seen").code, 0);
  const CsvTable rows = CsvTable::read(file("seen/energy.csv"));
  const auto at = [&rows](int row, const char* name) { return rows.number(row, rows.column(name)); };
  ASSERT_GT(rows.n_rows(), 5);
  for (int r = 1; r < rows.n_rows(); ++r) {
    for (const char* loss : {"viscous", "sliding"})
      EXPECT_GE(at(r, loss), (1.0 - 1e-4) * at(r - 1, loss)) << loss;
    EXPECT_EQ(at(r, "scaling"), 0.0);
    EXPECT_GE(at(r, "time"), at(r - 1, "time"));
  }
  const int last = rows.n_rows() - 1;
  EXPECT_GT(at(last, "viscous"), 0.0);
  EXPECT_LT(at(last, "kinetic"), 1e-9);
  // At the largest time step that is stable; a quarter of it leaves a fifth of that.
  EXPECT_LT(std::abs(at(last, "error")), 0.1 * (at(last, "viscous") + at(last, "sliding")));
}

TEST_F(TrackEnergy, GoesOnWhereItStoppedWithTheSameTable) {
  ASSERT_EQ(floc(std::string(kRun) + "whole").code, 0);
  const std::string resumed = std::string(kRun) + "halves --resume";
  ASSERT_EQ(
      floc("run small.toml --set equilibrium.finish=\"\\\"dynamic\\\"\" --until 0 --track-energy -o halves")
          .code,
      0);
  ASSERT_EQ(floc(resumed).code, 0);
  EXPECT_EQ(content_of(file("halves/energy.csv")), content_of(file("whole/energy.csv")));
  EXPECT_EQ(content_of(file("halves/state-0001.h5")), content_of(file("whole/state-0001.h5")));
}

/// A stage that changes the law puts in what the stored energy changes by; the account goes on from a state alike.
TEST_F(TrackEnergy, HasAColumnForChangesOfTheLaw) {
  const std::string scene = small_scene();
  write_text(file("small.toml"),
             scene.substr(0, scene.find("[[load]]")) +
                 "[[load]]\nto = 0.01\nsteps = 1\nset = {adhesion.force = 0.5}\n[run]\nseed = 3\n");
  const std::string run = "run small.toml --set equilibrium.finish=dynamic --track-energy -o ";
  ASSERT_EQ(floc(run + "whole").code, 0);
  ASSERT_EQ(floc(run + "halves --until 1").code, 0);
  ASSERT_EQ(floc(run + "halves --resume").code, 0);
  EXPECT_EQ(content_of(file("halves/energy.csv")), content_of(file("whole/energy.csv")));
  const CsvTable rows = CsvTable::read(file("whole/energy.csv"));
  const auto at = [&rows](int row, const char* name) { return rows.number(row, rows.column(name)); };
  int first = 0;  // row of the stage
  while (at(first, "step") < 2) ++first;
  ASSERT_GT(first, 0);
  EXPECT_EQ(at(first - 1, "law"), 0.0);
  EXPECT_GT(std::abs(at(first, "law")), 0.0);
  const int last = rows.n_rows() - 1;
  EXPECT_EQ(at(last, "law"), at(first, "law"));
  // Of the change nothing is left to the error, which stays that of the motion.
  EXPECT_LT(std::abs(at(last, "error") - at(first - 1, "error")), 0.1 * std::abs(at(last, "law")));
}

TEST_F(TrackEnergy, IsRefusedWhereNoMotionLeadsToAnEquilibrium) {
  const Outcome o = floc("run small.toml -o none --track-energy");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("expected equilibrium.finish = \"dynamic\""));
  EXPECT_NE(floc(std::string(kRun) + "none --track-contacts 1").code, 0);
  const std::string scene = small_scene();
  write_text(file("small.toml"),
             scene.substr(0, scene.find("[[load]]")) +
                 "[[load]]\ncontrol = \"simple_shear\"\nstrain = 0.1\nsteps = 1\n[run]\nseed = 3\n");
  const Outcome sheared = floc(std::string(kRun) + "sheared");
  EXPECT_EQ(sheared.code, 4);
  EXPECT_THAT(sheared.err, HasSubstr("is a simple shear"));
}

}  // namespace
}  // namespace floc::test
