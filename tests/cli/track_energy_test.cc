#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>

#include "floc/io/csv.h"
#include "floc/scene/read_scene.h"
#include "support/kill_and_resume.h"
#include "support/places.h"
#include "support/run_arguments.h"

namespace floc::test {
namespace {

using ::testing::HasSubstr;

const char* const kRun =
    "run small.toml --set equilibrium.finish=\"\\\"dynamic\\\"\" --until 1 --track-energy -o ";

/// Fixture: a short run with --track-energy.
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
  // The run uses the largest stable time step. With a quarter of this time step, the error would be five times smaller.
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

/// In a stage that changes the law, the change of the stored energy is added to the column `law`. The table must be
/// equal if the run is stopped and resumed.
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
  int first = 0;  // first row of the stage that changes the law
  while (at(first, "step") < 2) ++first;
  ASSERT_GT(first, 0);
  EXPECT_EQ(at(first - 1, "law"), 0.0);
  EXPECT_GT(std::abs(at(first, "law")), 0.0);
  const int last = rows.n_rows() - 1;
  EXPECT_EQ(at(last, "law"), at(first, "law"));
  // The error must not contain the change of the law, only the error of the motion.
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
  for (const char* directory : {"none", "sheared"}) EXPECT_FALSE(std::filesystem::exists(file(directory)));
}

/// Returns the reason why --track-energy is refused for a shipped scene, empty if it is accepted.
/// @param dynamic  whether equilibrium.finish = "dynamic" is set
std::string refusal_of(const Scene& scene, bool dynamic) {
  if (scene.assembly.box) return "the scene has walls (table [box])";
  if (scene.law.is_rigid()) return dynamic ? "" : "store no elastic energy";
  if (!dynamic && scene.relaxation.finish != Finish::dynamic)
    return "expected equilibrium.finish = \"dynamic\"";
  for (const LoadStage& stage : scene.load)
    if (stage.shear != 0.0) return "is a simple shear";
  return scene.assembly.vibration ? "assembly.vibration displaces the grains" : "";
}

/// --track-energy must be refused before any file is written, both for a single run and for several runs.
TEST_F(TrackEnergy, IsRefusedForShippedScenesOfWhichNoAccountIsKept) {
  std::map<std::string, int> n_refused;
  for (const auto& entry : std::filesystem::directory_iterator(source_directory() + "/data/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const Scene scene = read_scene(entry.path());
    for (const bool dynamic : {false, true}) {
      const std::string words = refusal_of(scene, dynamic);
      if (words.empty() || (dynamic && scene.assembly.box)) continue;
      for (const char* several : {"", " --seeds 1..2"}) {
        const Outcome o = floc("run " + entry.path().string() + " -o none --track-energy" + several +
                               (dynamic ? " --set equilibrium.finish=dynamic" : ""));
        EXPECT_EQ(o.code, 4) << entry.path();
        EXPECT_THAT(o.err, HasSubstr("--track-energy: ")) << entry.path();
        EXPECT_THAT(o.err, HasSubstr(words)) << entry.path();
        EXPECT_FALSE(std::filesystem::exists(file("none"))) << entry.path();
        ++n_refused[words];
      }
    }
  }
  for (const auto& [words, n] : n_refused) std::cout << n << " refusals: " << words << "\n";
  EXPECT_GE(n_refused["the scene has walls (table [box])"], 4);
  EXPECT_GE(n_refused["assembly.vibration displaces the grains"], 2);
}

/// A shipped scene and the number of an equilibrium of its run, chosen so that all kinds of loads of the scene occur
/// before this equilibrium.
struct ShippedPath {
  const char* scene;
  int until;
};
void PrintTo(const ShippedPath& path, std::ostream* out) {
  *out << path.scene;
}

class EnergyOfShippedPath : public ::testing::TestWithParam<ShippedPath> {
 protected:
  /// Runs the path with a few grains. Returns the error of the energy balance at the end, divided by the work of the
  /// boundary.
  double error_at(double time_step) const {
    const std::string directory = fmt::format("at-{}", time_step);
    const Outcome o = run_floc(
        fmt::format("run {}/data/scenes/{}.toml --set grains.count=16 --set equilibrium.finish=dynamic "
                    "--set equilibrium.force=1e-3 --set equilibrium.moment=1e-3 --set equilibrium.stress=1e-3 "
                    "--set equilibrium.energy=1e-5 --set run.time_step={} --until {} --track-energy -o {}",
                    source_directory(), GetParam().scene, time_step, GetParam().until, directory),
        scratch_.path());
    EXPECT_EQ(o.code, 0) << o.err;
    const CsvTable rows = CsvTable::read(scratch_.file(directory + "/energy.csv"));
    const auto last = [&rows](const char* name) { return rows.number(rows.n_rows() - 1, rows.column(name)); };
    return std::abs(last("error")) / std::abs(last("work"));
  }

  ScratchDirectory scratch_;
};

/// With a quarter of the time step, the error decreases to about a quarter; not exactly, because the two runs follow
/// different paths.
TEST_P(EnergyOfShippedPath, ClosesWithTheTimeStepOfTheRun) {
  const double coarse = error_at(0.36), fine = error_at(0.09);
  std::cout << GetParam().scene << ": error over work " << coarse << " and at a quarter of the step " << fine
            << ", order " << 0.5 * std::log2(coarse / fine) << "\n";
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_LT(fine, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EnergyOfShippedPath,
                         testing::Values(ShippedPath{"cohesionless_cycle", 1}, ShippedPath{"biaxial_dense", 1},
                                         ShippedPath{"constant_volume", 1}, ShippedPath{"oedometer", 2},
                                         ShippedPath{"stiff_contacts", 1}, ShippedPath{"wet_tension", 2},
                                         ShippedPath{"spheres_demo", 1}));

}  // namespace
}  // namespace floc::test
