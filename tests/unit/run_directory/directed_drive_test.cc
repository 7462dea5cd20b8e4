#include <gtest/gtest.h>

#include <cmath>

#include "floc/io/csv.h"
#include "floc/io/state_file.h"
#include "floc/run_directory/drive.h"
#include "floc/scene/read_scene.h"
#include "floc/verification/verification.h"
#include "support/kill_and_resume.h"
#include "support/scene_text.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

/// Returns a scene of disks without adhesion with the given loads. If `finish` is "dynamic", only the motion of the
/// grains leads to equilibria. The run then takes many steps and can be stopped between them.
Scene scene_of(const std::string& loads, const std::string& finish) {
  const std::string disks = test::exchanged(test::scene_text("disks"), "count = 40", "count = 30");
  return parse_scene(disks + loads + "[equilibrium]\nfinish = \"" + finish + "\"\n", "directed.toml", ".");
}

Scene directed(const std::string& finish) {
  return scene_of(R"([[load]]
control = "oedometric"
to = 2.0
steps = 2
[[load]]
control = "triaxial"
axis = 1
strain = 0.01
strain_step = 5e-3
[[load]]
control = "constant_volume"
strain = -4e-3
steps = 1
)",
                  finish);
}
constexpr int kDirectedEquilibria = 6;

DriveReport drive_in(const std::string& path, const Scene& scene, const DriveOptions<2>& driving) {
  RunDirectory directory(path, Existing::resume, scene);
  floc::Run<2> run = start_or_resume<2>(directory, scene);
  return drive(run, directory, driving);
}

TEST(DirectedDrive, ARunStoppedAnywhereAndResumedIsTheUnbrokenRun) {
  const test::ScratchDirectory scratch;
  const Scene scene = directed("dynamic");
  ASSERT_EQ(drive_in(scratch.file("whole"), scene, {}).outcome, DriveReport::done);
  DriveOptions<2> driving;
  int n_chunks = 0, n_stops = 0;
  driving.stop = [&] { return ++n_chunks % 3 == 0; };
  while (drive_in(scratch.file("broken"), scene, driving).outcome == DriveReport::stopped) ++n_stops;
  EXPECT_GT(n_stops, 3);
  test::expect_same_results(scratch.file("whole"), scratch.file("broken"), kDirectedEquilibria);
}

TEST(DirectedDrive, MakesStatesThatVerifyAndRowsOfTheirAxes) {
  const test::ScratchDirectory scratch;
  ASSERT_EQ(drive_in(scratch.file("run"), directed("auto"), {}).outcome, DriveReport::done);
  int n_lengths = 0;
  for (int k = 0; k < kDirectedEquilibria; ++k) {
    const auto state = std::get<State<2>>(read_state(state_file(scratch.file("run"), k)));
    for (const Criterion& c : verify_equilibrium(state)) {
      EXPECT_TRUE(c.holds) << k << " " << c.name << " " << c.where;
      n_lengths += c.name == std::string("length");
    }
    EXPECT_EQ(state.path.turn.empty(), k == 0);
  }
  EXPECT_EQ(n_lengths, kDirectedEquilibria - 1);
  const CsvTable path = CsvTable::read(scratch.file("run/path.csv"));
  const auto at = [&](int row, const char* name) { return path.number(row, path.column(name)); };
  EXPECT_TRUE(path.is_empty(0, path.column("control")));
  EXPECT_EQ(path.text(1, path.column("control")), "oedometric");
  EXPECT_EQ(at(2, "strain_1"), 0.0);
  EXPECT_NEAR(at(2, "stress_2"), 2.0, 1e-4);
  EXPECT_NEAR(at(2, "K0"), at(2, "stress_1") / at(2, "stress_2"), 1e-12);
  EXPECT_NEAR(at(4, "strain_1"), 0.01, 1e-12);
  EXPECT_NEAR(at(4, "mobilised_friction"), (at(4, "stress_1") - at(4, "stress_2")) / (2 * at(4, "p")), 1e-12);
  EXPECT_NEAR(at(5, "volumetric_strain"), at(4, "volumetric_strain"), 1e-12);
  EXPECT_NEAR(at(5, "strain_2") - at(4, "strain_2"), -4e-3, 1e-12);
}

/// The tilt of the lattice is reduced before the second step of the shear. All states, before and after this
/// reduction, must pass the verification.
TEST(DirectedDrive, ASimpleShearStoppedAnywhereVerifiesAndIsTheUnbrokenRun) {
  const test::ScratchDirectory scratch;
  const Scene scene = scene_of(
      "[[load]]\ncontrol = \"simple_shear\"\nstrain = 1.2\nsteps = 2\n[[load]]\nto = 2.0\nsteps = 1\n", "auto");
  ASSERT_EQ(drive_in(scratch.file("whole"), scene, {}).outcome, DriveReport::done);
  DriveOptions<2> driving;
  int n_chunks = 0, n_stops = 0;
  driving.stop = [&] { return ++n_chunks % 20 == 0; };
  while (drive_in(scratch.file("broken"), scene, driving).outcome == DriveReport::stopped) ++n_stops;
  EXPECT_GT(n_stops, 3);
  test::expect_same_results(scratch.file("whole"), scratch.file("broken"), 4);
  for (int k = 0; k < 4; ++k) {
    const auto state = std::get<State<2>>(read_state(state_file(scratch.file("whole"), k)));
    for (const Criterion& c : verify_equilibrium(state))
      EXPECT_TRUE(c.holds) << k << " " << c.name << " " << c.where;
  }
  const CsvTable path = CsvTable::read(scratch.file("whole/path.csv"));
  const auto at = [&](int row, const char* name) { return path.number(row, path.column(name)); };
  for (const int k : {1, 2}) {
    EXPECT_EQ(path.text(k, path.column("control")), "simple_shear");
    EXPECT_NEAR(at(k, "shear_strain"), 0.6 * k, 1e-14);
    EXPECT_NEAR(at(k, "mobilised_friction"), at(k, "shear_stress") / at(k, "stress_2"), 1e-12);
    EXPECT_TRUE(path.is_empty(k, path.column("dilatancy")));
  }
  EXPECT_TRUE(path.is_empty(3, path.column("shear_strain")));
}

/// If the offset of the lattice in a state differs from the imposed offset, the state fails the verification.
TEST(DirectedDrive, AnOffsetThatIsOffIsFound) {
  const test::ScratchDirectory scratch;
  DriveOptions<2> driving;
  driving.until = 1;
  const Scene scene = scene_of("[[load]]\ncontrol = \"simple_shear\"\nstrain = 1e-3\nsteps = 1\n", "auto");
  ASSERT_EQ(drive_in(scratch.file("run"), scene, driving).outcome, DriveReport::done);
  auto state = std::get<State<2>>(read_state(state_file(scratch.file("run"), 1)));
  ASSERT_TRUE(state.target_offset.has_value());
  state.target_offset->offset += 1e-9;
  for (const Criterion& c : verify_equilibrium(state))
    EXPECT_EQ(c.holds, c.name != std::string("length")) << c.name;
}

/// If a length in a state differs from the imposed length, the state fails the verification.
TEST(DirectedDrive, ALengthThatIsOffIsFound) {
  const test::ScratchDirectory scratch;
  DriveOptions<2> driving;
  driving.until = 1;
  ASSERT_EQ(drive_in(scratch.file("run"), directed("auto"), driving).outcome, DriveReport::done);
  auto state = std::get<State<2>>(read_state(state_file(scratch.file("run"), 1)));
  state.target_side[0] *= 1.0 + 1e-9;
  for (const Criterion& c : verify_equilibrium(state))
    EXPECT_EQ(c.holds, c.name != std::string("length")) << c.name;
}

}  // namespace
}  // namespace floc
