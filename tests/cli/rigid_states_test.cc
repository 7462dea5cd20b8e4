#include "support/rigid_states.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "support/run_program.h"

/// Tests of every command that reads states, with states of rigid grains with and without corners.
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
  }
  Outcome run(const std::string& arguments) const { return run_floc(arguments, scratch_.path()); }

  ScratchDirectory scratch_;
};

/// Arguments of a command, in which `S` stands for the state file.
struct Case {
  const char* arguments;
  bool reads_bricks, reads_spheres;  ///< whether the command accepts the state
};

const Case kCommands[] = {
    {"info S", true, true},
    {"verify S", true, true},
    {"forces S --contacts f.csv --range", true, true},
    {"forces S --gap 1e-3 --selection canonical", true, true},
    {"network S --with bonds,phases --pdf d.csv --particle-stress p.csv --clusters c.csv", true, true},
    {"network S --without mechanics", true, true},
    {"structure S", false, true},
    {"moduli S", false, false},
    {"moduli S --kn 1 --kt 0.5", true, true},
    {"moduli S --method bounds --strains full", false, false},
    {"modes S", false, false},
    {"compare S S", false, true},
    {"draw S -o picture.svg", true, true},
    {"draw S -o picture.svg --forces kinds", true, false},
    {"plot --show forces S -o plot.svg", true, true},
    {"plot --show pressures S -o plot.svg", true, true},
    {"plot --show moduli S -o plot.svg", false, false},
    {"plot --show scattering S -o plot.svg", false, true},
    {"lattice S --matrix 0.2", false, true},
    {"export S --grains g.csv --contacts e.csv", false, true},
    {"convert S copy.h5 --overwrite", true, true},
    {"convert S copy.vtu --overwrite", true, true},
    {"convert S copy.vtkhdf --overwrite", false, true},
    {"convert S copy.xyz --overwrite", false, true},
};

TEST_F(RigidStates, GiveNumbersOrOneSentence) {
  for (const Case& one : kCommands)
    for (const bool bricks : {true, false}) {
      const std::string file = bricks ? "bricks.h5" : "spheres.h5";
      const std::string arguments = std::regex_replace(one.arguments, std::regex("\\bS\\b"), file);
      const Outcome outcome = run(arguments);
      SCOPED_TRACE(arguments + "\n" + outcome.out + outcome.err);
      if (bricks ? one.reads_bricks : one.reads_spheres) {
        EXPECT_EQ(outcome.code, 0);
        EXPECT_THAT(outcome.out, Not(::testing::ContainsRegex("nan|inf[,\n]")));
      } else {
        EXPECT_EQ(outcome.code, 4);
        EXPECT_THAT(outcome.err,
                    ::testing::ContainsRegex("the grains of this packing have corners|the contacts of "
                                             "this packing are rigid|the grains are disks or spheres"));
        EXPECT_THAT(outcome.err, ::testing::StartsWith("floc: "));
      }
      for (const char* internal : {"::", "_law", "std", "compose"})
        EXPECT_THAT(outcome.err, Not(HasSubstr(internal)));
    }
}

TEST_F(RigidStates, AreVerified) {
  for (const char* file : {"bricks.h5", "spheres.h5", "disks.h5"}) {
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

TEST_F(RigidStates, OfElasticGrainsWithCornersCannotBeVerified) {
  State<2> state = brick_bond(0.7, 0.3);
  LawParameters law;
  law.normal = LinearRepulsion{100.0};
  state.packing.law = law;
  write_state(scratch_.file("elastic.h5"), state);
  const Outcome outcome = run("verify elastic.h5");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("its grains have corners and its contacts are elastic"));
}

}  // namespace
}  // namespace floc::test
