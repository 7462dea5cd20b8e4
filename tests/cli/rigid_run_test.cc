#include "support/rigid_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "floc/io/csv.h"
#include "support/kill_and_resume.h"
#include "support/threaded_run.h"

namespace floc::test {
namespace {

TEST(RigidRun, KillsOfARunOfDisksLeaveNoTrace) {
  kill_and_resume(3, 21, rigid_scene(""), 4);
}

TEST(RigidRun, KillsOfARunOfPentagonsLeaveNoTrace) {
  kill_and_resume(3, 22, rigid_scene(kPentagons), 4);
}

TEST(RigidRun, KillsOfATriaxialTestOfPolyhedraLeaveNoTrace) {
  kill_and_resume(3, 26, rigid_scene(kCutStones, 3), 4);
}

TEST(RigidRun, KillsOfARunBetweenWallsLeaveNoTrace) {
  kill_and_resume(3, 23, rigid_box_scene(kPentagons), 2);
}

/// Boxes of disks, polygons, spheres and polyhedra give states that pass the verification. Runs with one and two
/// threads give identical states.
TEST(RigidRun, BetweenWallsVerifies) {
  for (const auto& [dimension, shape, contacts] : {std::tuple(2, "", kRigidContacts),
                                                   {2, kPentagons, kRigidContacts},
                                                   {3, "", kRigidContacts},
                                                   {3, kCutStones, kRigidContacts},
                                                   {2, kRoundedPentagons, kElasticContacts},
                                                   {3, kCapsules, kElasticContacts}}) {
    SCOPED_TRACE(testing::Message() << dimension << " " << shape << contacts);
    const ScratchDirectory scratch;
    write_text(scratch.file("s.toml"), rigid_box_scene(shape, dimension, contacts));
    const Outcome made = run_floc("run s.toml -o out --no-timing", scratch.path());
    ASSERT_EQ(made.code, 0) << made.err;
    const Outcome verified = run_floc("verify out/state-0000.h5 out/state-0001.h5", scratch.path());
    EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
    const CsvTable path = CsvTable::read(scratch.file("out/path.csv"));
    // The pressure on the lid must be the pressure of the load.
    EXPECT_NEAR(path.number(1, path.column("P")), 4.0, 1e-9);
    if (contacts == kRigidContacts) {
      EXPECT_EQ(run_floc("report out -o r.html", scratch.path()).code, 0);
    } else {
      for (const char* options : {"", " --prestress"})
        EXPECT_EQ(
            run_floc("moduli --strains diagonal out/state-0001.h5" + std::string(options), scratch.path()).code,
            0);
    }
    ASSERT_TRUE(run_with_threads(scratch.file("s.toml"), scratch.file("two"), 2));
    EXPECT_EQ(rows_without_seconds(scratch.file("out/path.csv")),
              rows_without_seconds(scratch.file("two/path.csv")));
  }
}

TEST(RigidRun, KillsOfARunOfElasticPentagonsLeaveNoTrace) {
  kill_and_resume(3, 24, elastic_scene(2), 4);
}

TEST(RigidRun, KillsOfElasticPentagonsBetweenWallsLeaveNoTrace) {
  kill_and_resume(3, 25, rigid_box_scene(kRoundedPentagons, 2, kElasticContacts), 2);
}

/// Elastic grains with corners give states that pass the verification. Their moduli are computed with the stiffnesses
/// of their own contact law.
TEST(RigidRun, ElasticGrainsWithCornersVerifyAndHaveModuli) {
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const ScratchDirectory scratch;
    write_text(scratch.file("s.toml"), elastic_scene(dimension));
    const Outcome made = run_floc("run s.toml -o out --no-timing", scratch.path());
    ASSERT_EQ(made.code, 0) << made.err;
    const Outcome verified = run_floc(
        "verify out/state-0000.h5 out/state-0001.h5 out/state-0002.h5 out/state-0003.h5", scratch.path());
    EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
    const Outcome moduli = run_floc("moduli out/state-0001.h5 --format csv", scratch.path());
    ASSERT_EQ(moduli.code, 0) << moduli.err;
    write_text(scratch.file("m.csv"), moduli.out);
    const CsvTable table = CsvTable::read(scratch.file("m.csv"));
    const double B = table.number(0, table.column("B"));
    EXPECT_LE(table.number(0, table.column("B_reuss")), B);
    EXPECT_LE(B, table.number(0, table.column("B_voigt")));
    // The geometric terms change the moduli by a few tens of P/K_N, relative to the moduli. P/K_N is 4e-4 here.
    write_text(scratch.file("p.csv"),
               run_floc("moduli out/state-0001.h5 --prestress --format csv", scratch.path()).out);
    const CsvTable with = CsvTable::read(scratch.file("p.csv"));
    EXPECT_NEAR(with.number(0, with.column("B_without_prestress")), B, 1e-9 * B);
    EXPECT_NEAR(with.number(0, with.column("B")), B, 0.05 * B);
    EXPECT_EQ(run_floc("modes out/state-0001.h5", scratch.path()).code, 0);
    EXPECT_THAT(run_floc("moduli out/state-0001.h5 --kn 1", scratch.path()).err,
                testing::HasSubstr("are elastic and have stiffnesses of their own"));
    EXPECT_THAT(run_floc("run s.toml -o tracked --track-energy", scratch.path()).err,
                testing::HasSubstr("the grains of the scene have shapes"));
    EXPECT_EQ(run_floc("report out -o r.html", scratch.path()).code, 0);
    ASSERT_TRUE(run_with_threads(scratch.file("s.toml"), scratch.file("two"), 2));
    EXPECT_EQ(rows_without_seconds(scratch.file("out/path.csv")),
              rows_without_seconds(scratch.file("two/path.csv")));
  }
}

/// Returns a scene that starts from the first state of the run in the directory `first` and doubles the pressure.
/// @param contacts  table [contact]
/// @param keys  further lines of the table [assembly]
std::string scene_from_state(int dimension, const std::string& contacts, const std::string& keys = "") {
  return "[scene]\nname = \"again\"\nunits = \"reduced\"\ndimension = " + std::to_string(dimension) + "\n" +
         contacts + "[assembly]\nprotocol = \"state\"\nstate = \"first/state-0000.h5\"\n" + keys +
         "[[load]]\nname = \"load\"\nto = 2.0\nsteps = 1\n[run]\nseed = 1\n";
}

/// Grains with shapes start from states of elastic and of rigid contacts, with either law. Under their own law they
/// are in equilibrium from the start.
TEST(RigidRun, StartsFromStatesOfGrainsWithShapes) {
  for (const int dimension : {2, 3})
    for (const bool was_rigid : {false, true})
      for (const bool is_rigid : {false, true}) {
        SCOPED_TRACE(testing::Message() << dimension << "D, rigid: " << was_rigid << " -> " << is_rigid);
        const ScratchDirectory scratch;
        write_text(scratch.file("first.toml"),
                   elastic_scene(dimension, was_rigid ? kRigidContacts : kElasticContacts));
        ASSERT_EQ(run_floc("run first.toml -o first --until 0", scratch.path()).code, 0);
        write_text(scratch.file("again.toml"),
                   scene_from_state(dimension, is_rigid ? kRigidContacts : kElasticContacts));
        const Outcome made = run_floc("run again.toml -o again", scratch.path());
        ASSERT_EQ(made.code, 0) << made.err;
        const Outcome verified = run_floc("verify again/state-0000.h5 again/state-0001.h5", scratch.path());
        EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
        const CsvTable before = CsvTable::read(scratch.file("first/path.csv"));
        const CsvTable after = CsvTable::read(scratch.file("again/path.csv"));
        const double largest_change = was_rigid || is_rigid ? 0.02 : 1e-9;
        EXPECT_NEAR(after.number(0, after.column("phi")), before.number(0, before.column("phi")),
                    largest_change);
        EXPECT_NEAR(after.number(1, after.column("P")), 2.0, 1e-6);
      }
}

/// Copies of a packing of elastic grains with shapes, side by side, are in equilibrium, too.
TEST(RigidRun, CopiesOfElasticGrainsAreInEquilibrium) {
  const ScratchDirectory scratch;
  write_text(scratch.file("first.toml"), elastic_scene(2));
  ASSERT_EQ(run_floc("run first.toml -o first --until 0", scratch.path()).code, 0);
  write_text(scratch.file("again.toml"), scene_from_state(2, kElasticContacts, "copies = [2, 1]\n"));
  const Outcome made = run_floc("run again.toml -o again --until 0", scratch.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(run_floc("verify again/state-0000.h5", scratch.path()).code, 0);
  const CsvTable one = CsvTable::read(scratch.file("first/path.csv"));
  const CsvTable two = CsvTable::read(scratch.file("again/path.csv"));
  for (const char* column : {"phi", "z"})
    EXPECT_NEAR(two.number(0, two.column(column)), one.number(0, one.column(column)), 1e-9) << column;
}

/// In the report of a run of grains with corners, the section on moduli is replaced by a section on contacts.
TEST(RigidRun, IsReported) {
  const ScratchDirectory scratch;
  write_text(scratch.file("s.toml"), rigid_scene(kPentagons));
  ASSERT_EQ(run_floc("run s.toml -o out", scratch.path()).code, 0);
  const Outcome made = run_floc("report out -o r.html", scratch.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(
      content_of(scratch.file("r.html")),
      testing::AllOf(testing::HasSubstr("40 polygons, 4 states"), testing::HasSubstr("<h2>Contacts</h2>"),
                     testing::HasSubstr("face-face"), testing::Not(testing::HasSubstr("<h2>Moduli</h2>"))));
}

}  // namespace
}  // namespace floc::test
