#include "support/rigid_states.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "floc/io/csv.h"
#include "floc/io/state_file.h"
#include "support/run_program.h"

/// Tests every command that reads states on states of rigid grains, with and without corners.
namespace floc::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class RigidStates : public ::testing::Test {
 protected:
  void SetUp() override {
    write_state(scratch_.file("bricks.h5"), brick_bond(0.7, 0.3));
    write_state(scratch_.file("spheres.h5"), cubic_crystal(0.7, 0.3));
    write_state(scratch_.file("disks.h5"), triangular_crystal(0.7, 0.0));
    write_state(scratch_.file("cubes.h5"), cube_stack(0.7, 0.3));
    write_state(scratch_.file("x.h5"), boxed_squares(0.7, 0.3));
  }
  Outcome run(const std::string& arguments) const { return run_floc(arguments, scratch_.path()); }

  ScratchDirectory scratch_;
};

/// Arguments of a command (with `S` in place of the name of the state file), and the states that the command accepts.
struct Case {
  const char* arguments;
  /// Letters of the accepted states: b for bricks, c for cubes, s for spheres, and x for squares in a box.
  const char* reads;
};

const Case kCommands[] = {
    {"info S", "bcsx"},
    {"verify S", "bcsx"},
    {"forces S --contacts f.csv --range", "bcsx"},
    {"forces S --gap 1e-3 --selection canonical", "bcsx"},
    {"network S --with bonds,phases --pdf d.csv --particle-stress p.csv --clusters c.csv", "bcsx"},
    {"network S --without mechanics", "bcsx"},
    {"structure S", "bcsx"},
    {"structure S --pair-correlation g.csv", "bcsx"},
    {"structure S --intensity i.csv", "s"},
    {"structure S --gaps z.csv", "s"},
    {"structure S --map m.csv", "s"},
    {"structure S --porosity p.csv", "s"},
    {"structure S --profile p.csv", "s"},
    {"structure S --pores p.csv", "s"},
    {"moduli S", ""},
    {"moduli S --kn 1 --kt 0.5", "bcsx"},
    {"moduli S --method bounds --strains full", ""},
    {"modes S", ""},
    {"compare S S", "bcs"},
    {"compare S S --contacts c.csv --displacements d.csv", "bcs"},
    {"draw S -o picture.svg", "bcsx"},
    {"draw S -o picture.svg --compare S", "bcs"},
    {"draw S -o picture.svg --forces kinds", "bcx"},
    {"draw S -o picture.svg --forces particle-pressure", "bcsx"},
    {"draw S -o picture.svg --forces phases", "bcs"},
    {"draw S -o picture.svg --forces increment", ""},
    {"draw S -o picture.svg --slab z,0.2,0.9", "cs"},
    {"plot --show forces S -o plot.svg", "bcsx"},
    {"plot --show pressures S -o plot.svg", "bcsx"},
    {"plot --show moduli S -o plot.svg", ""},
    {"plot --show scattering S -o plot.svg", "s"},
    {"lattice S --matrix 0.2", "s"},
    {"export S --grains g.csv --contacts e.csv", "bcsx"},
    {"export S --shapes s.csv", "bcx"},
    {"convert S copy.h5 --overwrite", "bcsx"},
    {"convert S copy.vtu --overwrite", "bcsx"},
    {"convert S copy.obj --overwrite", "cs"},
    {"convert S copy.vtkhdf --overwrite", "s"},
    {"convert S copy.xyz --overwrite", "s"},
    {"convert S copy.data --overwrite", "s"},
};

TEST_F(RigidStates, GiveNumbersOrOneSentence) {
  for (const Case& one : kCommands)
    for (const char* file : {"bricks.h5", "cubes.h5", "spheres.h5", "x.h5"}) {
      const std::string arguments = std::regex_replace(one.arguments, std::regex("\\bS\\b"), file);
      const Outcome outcome = run(arguments);
      SCOPED_TRACE(arguments + "\n" + outcome.out + outcome.err);
      if (std::string(one.reads).find(file[0]) != std::string::npos) {
        EXPECT_EQ(outcome.code, 0);
        EXPECT_THAT(outcome.out, Not(::testing::ContainsRegex("nan|inf[,\n]")));
      } else {
        EXPECT_EQ(outcome.code, 4);
        EXPECT_THAT(
            outcome.err,
            ::testing::ContainsRegex(
                "the grains of this packing have corners|the contacts of this packing are rigid|the grains are "
                "disks or spheres|all grains are disks or spheres|between walls|walls|this is a state in "
                "2D|the packing is "
                "two-dimensional"));
        EXPECT_THAT(outcome.err, ::testing::StartsWith("floc: "));
      }
      for (const char* internal : {"::", "_law", "std", "compose"})
        EXPECT_THAT(outcome.err, Not(HasSubstr(internal)));
    }
}

/// Tables of grains with corners: one row for each grain, contact point and vertex.
TEST_F(RigidStates, AreExportedWithShapesAndPoints) {
  EXPECT_EQ(run("export cubes.h5 --grains g.csv --contacts e.csv --shapes s.csv").code, 0);
  const CsvTable grains = CsvTable::read(scratch_.file("g.csv"));
  EXPECT_EQ(grains.n_rows(), 8);
  for (const char* column : {"shape", "scale", "qx", "qw"}) EXPECT_TRUE(grains.has(column)) << column;
  const CsvTable contacts = CsvTable::read(scratch_.file("e.csv"));
  EXPECT_EQ(contacts.n_rows(), 4 * 24);
  for (const char* column : {"point3", "normal3", "gap", "kind"}) EXPECT_TRUE(contacts.has(column)) << column;
  EXPECT_EQ(CsvTable::read(scratch_.file("s.csv")).n_rows(), 8);
}

/// All contact points of a pair of grains count together as one contact, even if they lie on different vertices, edges
/// or faces.
TEST_F(RigidStates, AreComparedByPairs) {
  const std::string row = run("compare cubes.h5 cubes.h5 --format json").out;
  EXPECT_THAT(row, HasSubstr("\"n_kept\": 24"));
  EXPECT_THAT(row, HasSubstr("\"n_lost\": 0"));
  EXPECT_THAT(row, HasSubstr("\"rigid_largest\": 8"));
}

/// Each pair of these cubes has four contact points.
TEST_F(RigidStates, HaveNamedStiffnessesForEachPointOrForEachPair) {
  const auto moduli = [&](const std::string& options) {
    write_text(scratch_.file("m.csv"), run("moduli cubes.h5 --format csv " + options).out);
    return CsvTable::read(scratch_.file("m.csv"));
  };
  const CsvTable point = moduli("--kn 1 --kt 0.5"), pair = moduli("--kn 4 --kt 2 --stiffness-per contact");
  for (const char* name : {"C11", "B", "G", "B_voigt", "B_reuss"})
    EXPECT_DOUBLE_EQ(pair.number(0, pair.column(name)), point.number(0, point.column(name))) << name;
  EXPECT_EQ(pair.number(0, pair.column("kn_named")), 4.0);
  EXPECT_EQ(pair.text(0, pair.column("stiffness_per")), "contact");
  EXPECT_EQ(point.text(0, point.column("stiffness_per")), "point");
  EXPECT_THAT(run("moduli cubes.h5 --kn 4 --kt 2 --stiffness-per contact").err,
              Not(HasSubstr("of the contact law")));
  const Outcome alone = run("moduli cubes.h5 --stiffness-per contact");
  EXPECT_EQ(alone.code, 4);
  EXPECT_THAT(alone.err, HasSubstr("--stiffness-per contact: expected the stiffnesses"));
}

TEST_F(RigidStates, AreVerified) {
  for (const char* file : {"bricks.h5", "spheres.h5", "disks.h5", "cubes.h5", "x.h5"}) {
    const Outcome outcome = run(std::string("verify --format json ") + file);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("\"cone\""));
  }
}

TEST_F(RigidStates, AreRestoredFromTheTablesThatExportWrites) {
  const std::string told = run("export spheres.h5 --grains g.csv --contacts e.csv").err;
  const std::size_t begin = told.find("convert g.csv");
  ASSERT_NE(begin, std::string::npos) << told;
  std::string command = told.substr(begin, told.find('\n', begin) - begin);
  command.replace(command.find("STATE.h5"), 8, "restored.h5");
  EXPECT_EQ(run(command).code, 0) << command;
  const Outcome outcome = run("verify restored.h5");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(RigidStates, ThatMoveFailWithTheGrainNamed) {
  State<2> state = brick_bond(0.7, 0.3);
  state.packing.grains.velocity[7] = Vec<2>(0.1, 0.0);
  measure(state);
  write_state(scratch_.file("moving.h5"), state);
  const Outcome outcome = run("verify moving.h5");
  EXPECT_EQ(outcome.code, 5);
  EXPECT_THAT(outcome.err, HasSubstr("most of all grain 7"));
}

TEST_F(RigidStates, NameTheirLawAndShapes) {
  EXPECT_THAT(run("info spheres.h5").out, HasSubstr("normal.law=rigid, friction.coefficient=0.3"));
  const std::string bricks = run("info bricks.h5 --format json").out;
  EXPECT_THAT(bricks, HasSubstr("\"n_shapes\": 1"));
  EXPECT_THAT(bricks, HasSubstr("\"most_faces\": 4"));
}

/// The forces in this state are not those of elastic springs, because the contacts do not overlap.
TEST_F(RigidStates, OfElasticGrainsWithCornersHaveTheForcesOfSprings) {
  State<2> state = brick_bond(0.7, 0.3);
  LawParameters law;
  law.normal = LinearRepulsion{100.0};
  state.packing.law = law;
  write_state(scratch_.file("elastic.h5"), state);
  const Outcome outcome = run("verify elastic.h5");
  EXPECT_EQ(outcome.code, 5);
  EXPECT_THAT(outcome.out, testing::ContainsRegex("elastic.h5,false,[a-z, ;\"]*law"));
}

}  // namespace
}  // namespace floc::test
