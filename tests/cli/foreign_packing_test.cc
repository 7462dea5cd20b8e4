#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "floc/base/read_file.h"
#include "support/places.h"
#include "support/run_arguments.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const std::string kPackings = source_directory() + "/data/packings/";
const std::string kLammpsLaw = "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800";
const std::string kLammpsColumns =
    "id1=c_pair[1],id2=c_pair[2],force1=c_force[1],force2=c_force[2],shear_force1=c_force[4],shear_force2=c_"
    "force[5]";

/// Fixture: a valid file of grains in a 4 x 4 cell. Each test adds a file with an error.
class ForeignPacking : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    write_text(scratch_.file(name), text);
    return scratch_.file(name);
  }
  /// Expects that `floc convert` rejects a table of grains and a table of contacts: it must print `message` and write
  /// no output file.
  void expect_refusal(const std::string& grains, const std::string& contacts, const std::string& message,
                      const std::string& cell = "4,0;0,4") {
    std::vector<std::string> arguments = {
        "convert", file("g.csv", grains), scratch_.file("s.h5"), "--law", "normal.stiffness=2", "--cell", cell};
    if (!contacts.empty()) {
      arguments.push_back("--contacts");
      arguments.push_back(file("c.csv", contacts));
    }
    const Outcome o = floc_arguments(arguments);
    EXPECT_EQ(o.code, 4);
    EXPECT_THAT(o.err, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(scratch_.file("s.h5")));
  }
  Outcome shell(const std::string& command) {
    return run_arguments("/bin/sh", {"-c", command, floc_program()});
  }

  const std::string kGrains = "id,x,y,radius\n1,1,1,0.5\n2,1.9,1,0.5\n";
  ScratchDirectory scratch_;
};

TEST_F(ForeignPacking, WithContactsOfAbsentGrainsIsRefused) {
  expect_refusal(kGrains, "id1,id2\n1,3\n",
                 "c.csv:2: id2 = 3: no grain has this id; the ids of grains are from 1 to 2");
}

TEST_F(ForeignPacking, InADegenerateCellIsRefused) {
  expect_refusal(kGrains, "", "--cell: the cell is degenerate", "4,4;2,2");
  expect_refusal(kGrains, "", "--cell: \"nan\" is not a finite number: expected numbers separated by commas",
                 "4,0;0,nan");
}

TEST_F(ForeignPacking, WithAZeroRadiusIsRefused) {
  expect_refusal("x,y,radius\n1,1,0.5\n2,2,0\n", "", "g.csv:3: radius = 0, must be positive");
}

TEST_F(ForeignPacking, WithAContactListedTwiceIsRefused) {
  expect_refusal(kGrains, "id1,id2\n1,2\n2,1\n",
                 "c.csv:3: the contact of grains 2 and 1 is listed twice, first at ");
}

TEST_F(ForeignPacking, WithNotANumberIsRefused) {
  expect_refusal("x,y,radius\n1,nan,0.5\n", "", "g.csv:2: y = \"nan\", expected a finite number");
  expect_refusal(kGrains, "id1,id2,normal_force\n1,2,inf\n",
                 "c.csv:2: normal_force = \"inf\", expected a finite number");
}

TEST_F(ForeignPacking, WithAContactOfHalfTheCellAndNoImageIsRefused) {
  expect_refusal(
      kGrains, "id1,id2,normal_force\n1,2,1\n",
      "c.csv:2: the centres of the grains are 0.9 apart, which is half the width of the cell (0.9) or more",
      "1.8,0;0,4");
}

TEST_F(ForeignPacking, OfADumpWithoutRadiiIsRefused) {
  const std::string dump =
      file("d.dump",
           "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
           "ITEM: ATOMS id x y z\n1 0 0 0\n");
  const Outcome o = floc_arguments({"convert", dump, scratch_.file("s.h5"), "--law", "normal.stiffness=1"});
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err,
              HasSubstr("d.dump: the dump has no column radius or diameter; its columns are id, x, y, z"));
}

TEST_F(ForeignPacking, ThatIsBadLeavesTheOthersOfTheCallDone) {
  const std::string good = file("good.csv", kGrains), bad = file("bad.csv", "x,y,radius\n1,1,0\n");
  const std::string last = file("last.csv", kGrains);
  std::filesystem::create_directory(scratch_.file("out"));
  const Outcome o = floc_arguments(
      {"convert", good, bad, last, scratch_.file("out"), "--law", "normal.stiffness=2", "--cell", "4,0;0,4"});
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("bad.csv:2: radius = 0"));
  EXPECT_TRUE(std::filesystem::exists(scratch_.file("out/good.h5")));
  EXPECT_TRUE(std::filesystem::exists(scratch_.file("out/last.h5")));
  EXPECT_FALSE(std::filesystem::exists(scratch_.file("out/bad.h5")));
  EXPECT_EQ(floc_arguments({"convert", good, last, scratch_.file("none.h5")}).code, 4);
}

TEST_F(ForeignPacking, OfLammpsAndYadeIsReadAnalysedAndWrittenInOtherFormats) {
  const Outcome lammps = floc_arguments({"convert", kPackings + "lammps/disks.dump", scratch_.file("disks.h5"),
                                         "--law", kLammpsLaw, "--contacts", kPackings + "lammps/disks.contacts",
                                         "--contact-columns", kLammpsColumns});
  ASSERT_EQ(lammps.code, 0) << lammps.err;
  EXPECT_THAT(lammps.err, AllOf(HasSubstr("time step 4054000"), HasSubstr("60 grains in 2D, 87 contacts"),
                                Not(HasSubstr("warning"))));
  const Outcome yade = floc_arguments({"convert", kPackings + "yade/spheres.txt", scratch_.file("spheres.h5"),
                                       "--units", "SI", "--contacts", kPackings + "yade/spheres.interactions"});
  ASSERT_EQ(yade.code, 0) << yade.err;
  EXPECT_THAT(yade.err, AllOf(HasSubstr("40 grains in 3D, 92 contacts"), Not(HasSubstr("warning"))));
  const Outcome moduli =
      floc_arguments({"moduli", scratch_.file("disks.h5"), scratch_.file("spheres.h5"), "--format", "json"});
  ASSERT_EQ(moduli.code, 0) << moduli.err;
  for (const json& row : json::parse(moduli.out)) {
    EXPECT_LE(row.at("B_reuss"), row.at("B_S"));
    EXPECT_LE(row.at("B_S"), row.at("B"));
    EXPECT_LE(row.at("B"), row.at("B_voigt"));
  }
  for (const std::string name : {"disks", "spheres"})
    for (const std::string extension : {".vtu", ".xyz", ".data"})
      EXPECT_EQ(floc_arguments({"convert", scratch_.file(name + ".h5"), scratch_.file(name + extension)}).code,
                0);
  // The forces are computed again from the positions in the file. The error of the pressure is the rounding error of
  // the positions times the stiffness of a contact.
  ASSERT_EQ(floc_arguments({"convert", scratch_.file("disks.xyz"), scratch_.file("again.h5"), "--law",
                            kLammpsLaw, "--tolerance", "1"})
                .code,
            0);
  const json rows = json::parse(
      floc_arguments({"info", scratch_.file("disks.h5"), scratch_.file("again.h5"), "--format", "json"}).out);
  EXPECT_EQ(rows[0].at("n_contacts"), rows[1].at("n_contacts"));
  EXPECT_NEAR(rows[0].at("phi").get<double>(), rows[1].at("phi").get<double>(), 1e-15);
}

TEST_F(ForeignPacking, ThatIsNoEquilibriumIsSaidToBeAndRefusedUnlessForced) {
  const std::string state = scratch_.file("s.h5");
  const Outcome converted = floc_arguments(
      {"convert", file("g.csv", kGrains), state, "--law", "normal.stiffness=2", "--cell", "4,0;0,4"});
  EXPECT_EQ(converted.code, 0);
  // The two grains have a single contact, whose force of 0.2 is not balanced. The pressure is P = 0.2 * 0.9/16/2. In
  // units of the force scale F1 = P a, the net force is 0.2/F1 = 35.6.
  EXPECT_THAT(converted.err, HasSubstr("warning: this state is not in equilibrium: net force of grain 1 in "
                                       "units of the force scale F1 is 35.6, but the limit is 0.001"));
  const Outcome refused = floc_arguments({"moduli", state, "--format", "csv"});
  EXPECT_EQ(refused.code, 5);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("s.h5: this state is not in equilibrium: net force of grain 1 in "
                                           "units of the force scale F1 is 35.6, but the limit is 0.001"),
                                 HasSubstr("--force")));
  EXPECT_EQ(std::count(refused.out.begin(), refused.out.end(), '\n'), 1);
  const Outcome forced = floc_arguments({"moduli", state, "--force", "--format", "csv"});
  EXPECT_EQ(forced.code, 0);
  EXPECT_THAT(forced.err, HasSubstr("warning: this state is not in equilibrium"));
  EXPECT_EQ(std::count(forced.out.begin(), forced.out.end(), '\n'), 2);
  ASSERT_EQ(floc_arguments({"convert", file("g.csv", kGrains), scratch_.file("loose.h5"), "--law",
                            "normal.stiffness=2", "--cell", "4,0;0,4", "--tolerance", "40"})
                .code,
            0);
  EXPECT_EQ(floc_arguments({"moduli", scratch_.file("loose.h5")}).code, 0);
}

TEST_F(ForeignPacking, IsAStepOfAPipeline) {
  for (const std::string name : {"a.h5", "b.h5"})
    ASSERT_EQ(floc_arguments({"convert", kPackings + "disks/disks16.txt", scratch_.file(name)}).code, 0);
  const std::string all = "'" + scratch_.path() + "'/*.h5";
  const Outcome cut = shell("\"$0\" moduli " + all + " --format csv | cut -d, -f3");
  EXPECT_EQ(cut.code, 0);
  EXPECT_EQ(cut.out, "n_grains\n16\n16\n");
  EXPECT_THAT(cut.err, IsEmpty());
  const Outcome head = shell("\"$0\" moduli " + all + " --format csv | head -1");
  EXPECT_THAT(head.out, StartsWith("file,dimension,"));
  EXPECT_THAT(head.err, IsEmpty());
  // If the reader of the pipe exits before the table is written, floc prints nothing. The exit code of floc is that of
  // a program that was ended by SIGPIPE, even if the parent process ignores SIGPIPE.
  for (const std::string ignored : {"", "trap '' PIPE; "}) {
    const Outcome gone =
        shell(ignored + "{ sleep 0.2; \"$0\" moduli " + all + " --format csv; echo code $? >&2; } | true");
    EXPECT_EQ(gone.err, "code 141\n");
  }
  const Outcome stdin_state =
      shell("cat '" + scratch_.file("a.h5") + "' | \"$0\" moduli - --format csv | cut -d, -f1,3");
  EXPECT_EQ(stdin_state.out, "file,n_grains\n-,16\n");
}

}  // namespace
}  // namespace floc::test
