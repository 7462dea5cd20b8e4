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

TEST(RigidRun, KillsOfARunBetweenWallsLeaveNoTrace) {
  kill_and_resume(3, 23, rigid_box_scene(kPentagons), 2);
}

/// Boxes of disks, polygons, spheres and polyhedra give states that pass verification. With two threads, the states are
/// identical.
TEST(RigidRun, BetweenWallsVerifies) {
  for (const auto& [dimension, shape] : {std::pair(2, ""), {2, kPentagons}, {3, ""}, {3, kCutStones}}) {
    SCOPED_TRACE(testing::Message() << dimension << " " << shape);
    const ScratchDirectory scratch;
    write_text(scratch.file("s.toml"), rigid_box_scene(shape, dimension));
    const Outcome made = run_floc("run s.toml -o out --no-timing", scratch.path());
    ASSERT_EQ(made.code, 0) << made.err;
    const Outcome verified = run_floc("verify out/state-0000.h5 out/state-0001.h5", scratch.path());
    EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
    const CsvTable path = CsvTable::read(scratch.file("out/path.csv"));
    // The pressure on the lid must be the pressure of the load.
    EXPECT_NEAR(path.number(1, path.column("P")), 4.0, 1e-9);
    EXPECT_EQ(run_floc("report out -o r.html", scratch.path()).code, 0);
    ASSERT_TRUE(run_with_threads(scratch.file("s.toml"), scratch.file("two"), 2));
    EXPECT_EQ(rows_without_seconds(scratch.file("out/path.csv")),
              rows_without_seconds(scratch.file("two/path.csv")));
  }
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
