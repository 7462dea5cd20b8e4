#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <sstream>

#include "floc/io/csv.h"
#include "support/box_scene.h"
#include "support/kill_and_resume.h"
#include "support/threaded_run.h"

namespace floc::test {
namespace {

/// Returns the text with one part replaced.
std::string with(std::string text, const std::string& old, const std::string& replacement) {
  text.replace(text.find(old), old.size(), replacement);
  return text;
}

class BoxRun : public ::testing::TestWithParam<int> {
 protected:
  Outcome run(const std::string& scene, const std::string& arguments) {
    write_text(scratch_.file("box.toml"), scene);
    return run_floc("run box.toml " + arguments, scratch_.path());
  }
  Outcome floc(const std::string& arguments) { return run_floc(arguments, scratch_.path()); }
  std::string file(const std::string& name) const { return scratch_.file(name); }

  ScratchDirectory scratch_;
};

TEST_P(BoxRun, MakesStatesThatVerifyAndRowsThatSayWhatWallsBear) {
  const Outcome made = run(box_scene(GetParam()), "-o out");
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome verified = floc("verify out/state-*.h5");
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  const std::string rows = content_of(file("out/path.csv"));
  EXPECT_THAT(rows,
              testing::HasSubstr("n_wall_contacts,z_wall,kinetic_over_elastic,n_mechanisms,p_wall_1,p_wall_2"));
  EXPECT_THAT(rows, testing::HasSubstr(",dynamic,"));
  EXPECT_EQ(floc("info out/state-0000.h5").code, 0);
}

/// Runs boxes in 2D and 3D with the laws that no other test of boxes uses: attraction at a distance (also by walls),
/// and rolling and twisting springs.
TEST_P(BoxRun, HoldsGrainsOfAllLaws) {
  const std::string friction = "friction = {coefficient = 0.4, stiffness = 1.5e3}\n";
  const std::string rolling = "rolling = {coefficient = 0.05, stiffness = 10.0}\n";
  const std::string twisting = "twisting = {coefficient = 0.05, stiffness = 10.0}\n";
  const std::string tail = with(box_scene(GetParam()), "law = \"constant\", force = 0.2",
                                "law = \"tail\", force = 0.2, range = 1e-2");
  const std::string dry = with(box_scene(GetParam()), "adhesion = {law = \"constant\", force = 0.2}\n", "");
  const std::string scenes[] = {
      tail,
      with(tail, "adhesion = 0\n", "adhesion = 0.1\n"),
      with(tail, friction, friction + rolling + (GetParam() == 3 ? twisting : "")),
      dry,
      with(with(dry, friction, ""), "friction = 0.4\n", "friction = 0\n"),
      with(with(tail, friction, ""), "friction = 0.4\n", "friction = 0\n"),
  };
  for (std::size_t k = 0; k < std::size(scenes); ++k) {
    const std::string out = "out" + std::to_string(k);
    const Outcome made = run(scenes[k], "-o " + out);
    ASSERT_EQ(made.code, 0) << k << ": " << made.err;
    const Outcome verified = floc("verify " + out + "/state-*.h5");
    EXPECT_EQ(verified.code, 0) << k << ": " << verified.out << verified.err;
    EXPECT_EQ(floc("moduli " + out + "/state-*.h5").code, 0) << k;
  }
}

/// For a box, the values that floc network and floc structure print agree with the row of path.csv. Columns of
/// quantities that are defined only with periodic images are empty.
TEST_P(BoxRun, IsMeasuredBetweenItsGrains) {
  ASSERT_EQ(run(box_scene(GetParam()), "-o out").code, 0);
  const Outcome network = floc(
      "network out/state-0001.h5 --with bonds,phases --exponents b.csv --particle-stress s.csv --format csv "
      "--columns z,z_plus,z_minus,n_contacts,n_bonds,M1,x0,energy_per_grain,hyperstaticity,energy_share_95");
  ASSERT_EQ(network.code, 0) << network.err;
  std::istringstream printed(network.out);
  const CsvTable row = CsvTable::parse("network", printed), path = CsvTable::read(file("out/path.csv"));
  for (const char* name : {"z", "z_plus", "z_minus"})
    EXPECT_NEAR(row.number(0, row.column(name)), path.number(1, path.column(name)), 1e-12) << name;
  EXPECT_EQ(row.integer(0, row.column("n_contacts")), row.integer(0, row.column("n_bonds")));
  EXPECT_GT(row.number(0, row.column("M1")), 0.0);
  for (const char* name : {"hyperstaticity", "energy_share_95"})
    EXPECT_TRUE(row.is_empty(0, row.column(name))) << name;
  // The mean of the particle pressures, weighted with the volumes of the grains, is the mean stress of all contacts,
  // including contacts with walls. At rest, this stress equals the pressure on the walls minus the friction of the
  // walls, up to net forces of 1e-5 F0.
  const CsvTable stress = CsvTable::read(file("s.csv"));
  double mean = 0.0, volume = 0.0, expected = 0.0;
  for (int i = 0; i < stress.n_rows(); ++i) {
    const double v = std::pow(stress.number(i, stress.column("radius")), GetParam());
    mean += v * stress.number(i, stress.column("pressure"));
    volume += v;
  }
  for (int a = 1; a <= GetParam(); ++a) {
    const std::string axis = std::to_string(a);
    expected +=
        path.number(1, path.column("p_wall_" + axis)) - path.number(1, path.column("p_friction_" + axis));
  }
  EXPECT_NEAR(mean / volume, expected / GetParam(), 2e-6);

  const Outcome structure = floc(
      "structure out/state-0001.h5 --pair-correlation g.csv --reach 1.5 --porosity e.csv "
      "--profile p.csv --format csv --columns phi,xi");
  ASSERT_EQ(structure.code, 0) << structure.err;
  const CsvTable probes = CsvTable::read(file("e.csv"));
  // The two void ratios differ because grains overlap the walls.
  EXPECT_NEAR(probes.number(probes.n_rows() - 1, probes.column("void_ratio_cell")),
              path.number(1, path.column("void_ratio")), 1e-4);
  EXPECT_EQ(CsvTable::read(file("g.csv")).n_rows(), 75);
  EXPECT_EQ(CsvTable::read(file("p.csv")).n_rows(), 20);
  for (const char* option :
       {"--map x.csv", "--intensity x.csv", "--pores x.csv", "--gaps x.csv", "--average"}) {
    const Outcome refused = floc(std::string("structure out/state-0001.h5 ") + option);
    EXPECT_EQ(refused.code, 4) << option;
    EXPECT_THAT(refused.err, testing::HasSubstr("only with periodic boundaries")) << option;
  }
}

TEST_P(BoxRun, GivesTheSameFilesForTwoThreads) {
  ASSERT_EQ(run(box_scene(GetParam()), "--until 0 -o one").code, 0);
  ASSERT_TRUE(run_with_threads(file("box.toml"), file("two"), 2, 0));
  expect_same_results(file("one"), file("two"), 1);
}

TEST_P(BoxRun, SurvivesTenKillsWithoutATrace) {
  kill_and_resume(10, 11, box_scene(GetParam()), 2);
}

/// A run can start from a saved box. The walls of the new run then start at their positions in the saved box.
TEST_P(BoxRun, StartsFromAStateWithWalls) {
  ASSERT_EQ(run(box_scene(GetParam()), "--until 0 -o first").code, 0);
  std::string next =
      with(box_scene(GetParam()), "protocol = \"direct\"\nsolid_fraction = 0.35\nkinetic_pressure = 0.02",
           "protocol = \"state\"\nstate = \"first/state-0000.h5\"");
  const std::size_t grains = next.find("[grains]"), contact = next.find("[contact]");
  next.erase(grains, contact - grains);
  const std::size_t sides = next.find("sides ="), mass = next.find("mass = 20");
  next.erase(sides, mass - sides);
  const Outcome made = run(next, "-o again");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(floc("verify again/state-*.h5").code, 0);
}

/// The pressure on the walls across one axis may differ from the pressure on the other walls.
TEST_P(BoxRun, PutsAStressOfItsOwnOnAnAxis) {
  const Outcome made =
      run(with(box_scene(GetParam()), "to = 0.2", "control = \"triaxial\"\nto = 0.2"), "-o out");
  ASSERT_EQ(made.code, 0) << made.err;
  const CsvTable path = CsvTable::read(file("out/path.csv"));
  ASSERT_EQ(path.n_rows(), 2);
  for (int a = 1; a <= GetParam(); ++a)
    EXPECT_NEAR(path.number(1, path.column("p_wall_" + std::to_string(a))), a == GetParam() ? 0.2 : 0.1, 2e-4);
  EXPECT_EQ(path.text(1, path.column("control")), "triaxial");
  EXPECT_EQ(floc("verify out/state-0001.h5").code, 0);
}

/// The moduli of a box lie between their bounds. The table of force increments numbers the walls after the grains.
TEST_P(BoxRun, HasModuliBetweenItsBounds) {
  ASSERT_EQ(run(box_scene(GetParam()), "--until 0 -o out").code, 0);
  const Outcome made = floc("moduli out/state-0000.h5 --increments inc.csv --format csv");
  ASSERT_EQ(made.code, 0) << made.err;
  write_text(file("moduli.csv"), made.out);
  const CsvTable row = CsvTable::read(file("moduli.csv"));
  const auto value = [&row](const char* name) { return row.number(0, row.column(name)); };
  EXPECT_GT(value("B_reuss"), 0.0);
  // The forces on the grains and the pressures on the walls are balanced only within 1e-3, so B_reuss may exceed B_S a
  // little.
  EXPECT_LE(value("B_reuss"), 1.01 * value("B_S"));
  EXPECT_LE(value("B_S"), value("B") * (1.0 + 1e-9));
  EXPECT_LE(value("B"), value("B_voigt"));
  EXPECT_NEAR(value("p_wall"), 0.1, 2e-4);
  // Every command prints the mean stress of the contacts as P, and the pressure on the walls as p_wall.
  const CsvTable path = CsvTable::read(file("out/path.csv"));
  EXPECT_NEAR(value("P"), path.number(0, path.column("p")), 1e-12);
  EXPECT_GT(std::abs(value("P") - value("p_wall")), 1e-4);
  for (const char* command : {"network", "info"}) {
    std::istringstream printed(
        floc(command + std::string(" out/state-0000.h5 --format csv --columns P,p_wall")).out);
    const CsvTable other = CsvTable::parse(command, printed);
    EXPECT_EQ(other.number(0, other.column("P")), value("P")) << command;
    EXPECT_EQ(other.number(0, other.column("p_wall")), value("p_wall")) << command;
  }
  const CsvTable increments = CsvTable::read(file("inc.csv"));
  std::int64_t last = 0;
  for (int k = 0; k < increments.n_rows(); ++k)
    last = std::max(last, increments.integer(k, increments.column("id2")));
  EXPECT_GE(last, 60);
}

/// In exported files, the lower corner of the box is at zero, and the walls of the box are listed.
TEST_P(BoxRun, IsExportedWithItsWalls) {
  ASSERT_EQ(run(box_scene(GetParam()), "--until 0 -o out").code, 0);
  ASSERT_EQ(floc("convert out/state-0000.h5 box.data").code, 0);
  EXPECT_THAT(content_of(file("box.data")), testing::HasSubstr("fix wall/gran"));
  ASSERT_EQ(floc("convert out/state-0000.h5 box.xyz").code, 0);
  EXPECT_THAT(content_of(file("box.xyz")), testing::HasSubstr("pbc=\"F F F\""));
  ASSERT_EQ(floc("convert out/state-0000.h5 box.vtu").code, 0);
  EXPECT_THAT(content_of(file("box.vtu")), testing::HasSubstr("Name=\"walls\""));
  const Outcome drawn = floc("draw out/state-0000.h5 -o box.svg");
  EXPECT_EQ(drawn.code, 0) << drawn.err;
}

INSTANTIATE_TEST_SUITE_P(Dimensions, BoxRun, testing::Values(2, 3));

/// If a packing in a box still has mechanisms at the stop_time, the state is saved with the ending "stopped".
TEST(BoxRun, RecordsWhatHasNotSettledAsStopped) {
  const ScratchDirectory scratch;
  write_text(scratch.file("box.toml"), with(box_scene(3), "stop_time = 200", "stop_time = 2"));
  const Outcome made = run_floc("run box.toml --until 0 -o out", scratch.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(content_of(scratch.file("out/path.csv")), testing::HasSubstr(",stopped,"));
  EXPECT_NE(run_floc("verify out/state-0000.h5", scratch.path()).code, 0);
}

/// `floc scene check` prints the dimensionless groups of a published study of boxes.
TEST(BoxSceneCheck, PrintsItsGroups) {
  const ScratchDirectory scratch;
  write_text(scratch.file("box.toml"), box_scene(3));
  const Outcome check = run_floc("scene check box.toml --format csv", scratch.path());
  ASSERT_EQ(check.code, 0) << check.err;
  EXPECT_THAT(check.out, testing::HasSubstr("\neta,2,"));
  EXPECT_THAT(check.out, testing::HasSubstr("\neta_star,0.02,"));
  EXPECT_THAT(check.out, testing::HasSubstr("\np_k/p,0."));
}

struct BadBox {
  const char *old, *replacement, *words;
};
class BoxRefusal : public ::testing::TestWithParam<BadBox> {};

TEST_P(BoxRefusal, NamesWhatWasExpected) {
  const ScratchDirectory scratch;
  write_text(scratch.file("bad.toml"), with(box_scene(3), GetParam().old, GetParam().replacement));
  const Outcome check = run_floc("scene check bad.toml", scratch.path());
  EXPECT_NE(check.code, 0);
  EXPECT_THAT(check.err + check.out, testing::HasSubstr(GetParam().words));
  EXPECT_THAT(check.err + check.out, testing::HasSubstr("bad.toml:"));
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, BoxRefusal,
    testing::Values(BadBox{"[box]", "[cell]\nmass = 1.0\n[box]",
                           "[cell] is not allowed together with [box]: expected either"},
                    BadBox{"mass = 20", "mass = -1", "box.mass = -1: expected a positive number"},
                    BadBox{"mass = 20\n", "", "box.mass is missing"},
                    BadBox{"friction = 0.4\nadhesion = 0\n", "adhesion = 0\n", "box.friction is missing"},
                    BadBox{"adhesion = 0\n", "", "box.adhesion is missing"},
                    BadBox{"adhesion = 0\n", "adhesion = -1\n",
                           "box.adhesion = -1: expected the pull-off force"},
                    BadBox{"sides = [1, 1, 1.3]", "sides = [1, 1]",
                           "box.sides has 2 numbers: expected 3, one for each axis"},
                    BadBox{"solid_fraction = 0.35\n", "", "expected more than the largest diameter"},
                    BadBox{"sides = [1, 1, 1.3]",
                           "sides = [1, 1, 1.3]\nboundary = {x = \"periodic\", y = \"periodic\", z = "
                           "\"fixed\"}",
                           "box.boundary: no wall can move under the pressure"},
                    BadBox{"pressure = 0.1", "pressure = 0", "box.pressure = 0: expected a positive number"},
                    BadBox{"solid_fraction = 0.35", "solid_fraction = 0.6",
                           "expected the solid fraction of the gas in (0, 0.49]"},
                    BadBox{"protocol = \"direct\"", "protocol = \"aggregation\"",
                           "in a scene with a table [box] the pressure acts from the start"},
                    BadBox{"kinetic_pressure = 0.02", "kinetic_pressure = -1",
                           "expected the kinetic pressure of the gas, a number >= 0"},
                    BadBox{"kinetic_pressure = 0.02", "agitation = 2",
                           "in a scene with a table [box] assembly.kinetic_pressure gives the speed"},
                    BadBox{"to = 0.2", "to = 0.2\ninertial_number_cap = 0.1",
                           "a scene with a table [box] has walls and no periodic cell"},
                    BadBox{"to = 0.2", "control = \"oedometric\"\nto = 0.2",
                           "load.0.control: the stage imposes a length on axis 1"},
                    BadBox{"to = 0.2", "control = \"triaxial\"\nstrain = 0.1",
                           "load.0.control: the stage imposes a length on axis 3"},
                    BadBox{"to = 0.2", "control = \"axes\"\naxes = [{stress = 1}, {as = 1}, {strain = 0.1}]",
                           "load.0.axes: the stage imposes a length on axis 3"},
                    BadBox{"force = 0.2", "force = 200", "of their diameter; expected at most 0.1"},
                    BadBox{"stop_time = 200", "stop_time = 200\nenergy_ratio = 1e-3",
                           "used only with equilibrium.end = \"energy_ratio\""}));

/// A stress can be imposed on an axis only if its walls can move; an axis with fixed walls is refused.
TEST(BoxRefusal, OfAStressThatNoWallCarries) {
  const ScratchDirectory scratch;
  const std::string fixed =
      with(box_scene(3), "sides = [1, 1, 1.3]", "sides = [1, 1, 1.3]\nboundary = {z = \"fixed\"}");
  const auto check = [&](int axis) {
    write_text(
        scratch.file("bad.toml"),
        with(fixed, "to = 0.2", "control = \"triaxial\"\naxis = " + std::to_string(axis) + "\nto = 0.2"));
    return run_floc("scene check bad.toml", scratch.path());
  };
  EXPECT_EQ(check(1).code, 0);
  const Outcome refused = check(3);
  EXPECT_NE(refused.code, 0);
  EXPECT_THAT(refused.err, testing::HasSubstr("axis 3 has no walls that could move under the imposed stress"));
}

/// A scene with a periodic cell rejects the keys of boxes.
TEST(BoxRefusal, OfKeysInAPeriodicScene) {
  const ScratchDirectory scratch;
  write_text(scratch.file("bad.toml"),
             with(small_scene(), "agitation = 3.0", "agitation = 3.0\nkinetic_pressure = 1"));
  const Outcome check = run_floc("scene check bad.toml", scratch.path());
  EXPECT_NE(check.code, 0);
  EXPECT_THAT(
      check.err,
      testing::HasSubstr("assembly.kinetic_pressure is not allowed here: it describes the gas between walls"));
}

/// Commands that support only periodic cells say so in their message.
TEST(BoxRefusal, OfCommandsThatKnowPeriodicCellsAlone) {
  const ScratchDirectory scratch;
  write_text(scratch.file("box.toml"), box_scene(2));
  ASSERT_EQ(run_floc("run box.toml --until 0 -o out", scratch.path()).code, 0);
  for (const char* command :
       {"modes out/state-0000.h5", "report out -o r.html", "moduli out/state-0000.h5 --strains full"}) {
    const Outcome refused = run_floc(command, scratch.path());
    EXPECT_NE(refused.code, 0) << command;
    EXPECT_THAT(refused.err, testing::HasSubstr("has walls")) << command;
  }
  const Outcome tracked = run_floc("run box.toml --track-contacts 1 -o tracked", scratch.path());
  EXPECT_THAT(tracked.err, testing::HasSubstr("contacts are tracked only in periodic cells"));
}

}  // namespace
}  // namespace floc::test
