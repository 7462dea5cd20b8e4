#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "floc/base/read_file.h"
#include "support/places.h"
#include "support/run_arguments.h"

namespace floc::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kTwoGrains = "X,Y,R\n1,1,0.5\n1.9,1,0.5\n";

nlohmann::json info(const std::string& state) {
  return nlohmann::json::parse(floc_arguments({"info", state, "--format", "json"}).out).at(0);
}

TEST(Convert, OfTheSameFileGivesTheSameBytes) {
  const ScratchDirectory scratch;
  ASSERT_EQ(floc_arguments({"convert", jambashbulk_file(), scratch.file("a.h5")}).code, 0);
  ASSERT_EQ(floc_arguments({"convert", jambashbulk_file(), scratch.file("b.h5")}).code, 0);
  EXPECT_EQ(read_file(scratch.file("a.h5")), read_file(scratch.file("b.h5")));
}

TEST(Convert, TakesAPackingFromStdin) {
  const ScratchDirectory scratch;
  const Outcome result =
      floc_arguments({"convert", "-", scratch.file("s.h5"), "--law", "normal.stiffness=2", "--cell", "4,0;0,4",
                      "--columns", "x=X,y=Y,radius=R", "--stress", "0.01,0.02"},
                     kTwoGrains);
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  const auto said = info(scratch.file("s.h5"));
  EXPECT_EQ(said["n_contacts"], 1);
  EXPECT_EQ(said["law"], "normal.stiffness=2");
  EXPECT_EQ(said["source"], "stdin");
  EXPECT_EQ(said["target"], "0.01,0.02");
  // There is one contact along x, with the force 0.2 and the branch length 0.9, in a cell of area 16. The pressure is
  // therefore P = 0.2 * 0.9/16/2.
  EXPECT_NEAR(said["P"].get<double>(), 0.18 / 32.0, 1e-16);
}

/// The formats of floc and of other programs that are recognised by content give the same state from a file and from
/// standard input.
TEST(Convert, RecognisesAFormatOnStdinByItsContent) {
  const ScratchDirectory scratch;
  const std::string data = source_directory() + "/data/packings/";
  const std::string law = "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800";
  ASSERT_EQ(
      floc_arguments({"convert", data + "lammps/disks.dump", scratch.file("lammps.h5"), "--law", law}).code, 0);
  std::vector<std::string> files = {data + "lammps/disks.dump", jambashbulk_file(), scratch.file("lammps.h5")};
  for (const std::string extension : {".vtu", ".vtkhdf", ".xyz", ".data"}) {
    files.push_back(scratch.file("p" + extension));
    ASSERT_EQ(floc_arguments({"convert", scratch.file("lammps.h5"), files.back()}).code, 0);
  }
  for (const std::string& path : files) {
    std::vector<std::string> options = {"--overwrite"};
    if (path != jambashbulk_file() && !path.ends_with(".h5")) options.insert(options.end(), {"--law", law});
    const auto state = [&](const std::string& in, const std::string& content) {
      std::vector<std::string> arguments = {"convert", in, scratch.file("s.h5")};
      arguments.insert(arguments.end(), options.begin(), options.end());
      const Outcome result = floc_arguments(arguments, content);
      EXPECT_EQ(result.code, 0) << path << "\n" << result.err;
      auto said = info(scratch.file("s.h5"));
      for (const char* of_file : {"source", "sha256", "file"}) said.erase(of_file);
      return said;
    };
    EXPECT_EQ(state("-", read_file(path)), state(path, "")) << path;
  }
}

TEST(Convert, RefusesTwoInputsWithOneOutput) {
  const ScratchDirectory scratch;
  for (const char* folder : {"a", "b", "out"}) std::filesystem::create_directory(scratch.file(folder));
  for (const char* name : {"a/x.txt", "b/x.txt", "b/x.dat"})
    std::filesystem::copy_file(jambashbulk_file(), scratch.file(name));
  for (const char* second : {"b/x.txt", "b/x.dat", "a/x.txt"})
    for (const bool overwrite : {false, true}) {
      std::vector<std::string> arguments = {"convert", scratch.file("a/x.txt"), scratch.file(second),
                                            scratch.file("out")};
      if (overwrite) arguments.emplace_back("--overwrite");
      const Outcome result = floc_arguments(arguments);
      EXPECT_EQ(result.code, 4) << second;
      EXPECT_THAT(result.err, AllOf(HasSubstr("out/x.h5: both "), HasSubstr("would be written to this file")));
      EXPECT_TRUE(std::filesystem::is_empty(scratch.file("out")));
    }
}

TEST(Convert, LeavesAnExistingFileAloneUnlessToldTo) {
  const ScratchDirectory scratch;
  std::ofstream(scratch.file("s.h5")) << "mine";
  const Outcome refused = floc_arguments({"convert", jambashbulk_file(), scratch.file("s.h5")});
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("s.h5"), HasSubstr("exists already; give --overwrite")));
  EXPECT_EQ(read_file(scratch.file("s.h5")), "mine");
  EXPECT_EQ(floc_arguments({"convert", jambashbulk_file(), scratch.file("s.h5"), "--overwrite"}).code, 0);
  EXPECT_EQ(info(scratch.file("s.h5"))["n_grains"], 16);
}

TEST(Convert, SaysWhatItCannotDoAndLeavesNothingBehind) {
  const ScratchDirectory scratch;
  for (const char* name : {"g.csv", "g.xyz"})
    std::ofstream(scratch.file(name)) << "east,north,R\n0,0,0.5\n0.9,0,0.5\n";
  const std::string out = scratch.file("s.h5");
  const auto expect = [&](int code, const std::string& message, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "convert");
    const Outcome result = floc_arguments(arguments);
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  expect(4, "nowhere.csv: No such file",
         {scratch.file("nowhere.csv"), out, "--law", "normal.stiffness=1", "--cell", "4,0;0,4"});
  expect(4,
         "g.xyz: the format of the file is not recognised; give the format with --from: one of state (state "
         "file of "
         "floc, .h5), csv",
         {scratch.file("g.xyz"), out});
  expect(4, "\"lammps\" is not a format", {scratch.file("g.xyz"), out, "--from", "lammps"});
  expect(4, "--law: \"stiffness\" is not a parameter", {scratch.file("g.csv"), out, "--law", "stiffness=1"});
  expect(4, "--cell: \"4:\"",
         {scratch.file("g.csv"), out, "--law", "normal.stiffness=1", "--cell", "4,4:;0,4"});
  expect(4, "--columns: \"x\"", {scratch.file("g.csv"), out, "--columns", "x"});
  expect(4, "has no column \"x\"",
         {scratch.file("g.csv"), out, "--law", "normal.stiffness=1", "--cell", "4,0;0,4"});
  expect(4,
         "s.pdb: the extension of this file name does not determine a format: expected a name that ends in one "
         "of .h5 (state: "
         "state file of floc), .vtu",
         {jambashbulk_file(), scratch.file("s.pdb")});
  expect(4, "--to: \"pdb\" is not a format", {jambashbulk_file(), out, "--to", "pdb"});
  expect(4, "--stress: the stress has 1 numbers, expected 2", {jambashbulk_file(), out, "--stress", "1"});
  expect(4, "leave out --law", {jambashbulk_file(), out, "--law", "normal.stiffness=2"});
  expect(1, "cannot be written", {jambashbulk_file(), scratch.file("g.csv/s.h5")});
  expect(2, "IN... OUT is required", {});
  expect(2, "IN... OUT", {jambashbulk_file()});
  expect(2, "--units", {jambashbulk_file(), out, "--units", "imperial"});
}

TEST(Info, SaysWhereAStateComesFrom) {
  const ScratchDirectory scratch;
  ASSERT_EQ(floc_arguments({"convert", jambashbulk_file(), scratch.file("s.h5")}).code, 0);
  const auto said = info(scratch.file("s.h5"));
  EXPECT_THAT(said["program"].get<std::string>(), StartsWith("floc "));
  EXPECT_THAT(said["source"].get<std::string>(), StartsWith("disks16.txt, SHA-256 d74e8cd04c9f398c"));
  EXPECT_NEAR(said["P_star"].get<double>(), 1e-3, 1e-12);  // P_star = P/K_N, since there is no adhesion
  EXPECT_EQ(said["z"], 4.125);
  EXPECT_THAT(floc_arguments({"info", scratch.file("s.h5"), "--format", "table"}).out,
              HasSubstr("n_grains        16\n"));
}

TEST(Info, OfManyStatesSkipsTheBadOneAndSaysSo) {
  const ScratchDirectory scratch;
  ASSERT_EQ(floc_arguments({"convert", jambashbulk_file(), scratch.file("s.h5")}).code, 0);
  const Outcome result =
      floc_arguments({"info", scratch.file("s.h5"), scratch.file("none.h5"), scratch.file("s.h5")});
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.err, HasSubstr("none.h5: No such file"));
  EXPECT_THAT(result.out, StartsWith("file,dimension,units,n_grains,"));
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3);
}

TEST(Info, ThatCannotBePrintedIsAFailure) {
  const ScratchDirectory scratch;
  ASSERT_EQ(floc_arguments({"convert", jambashbulk_file(), scratch.file("s.h5")}).code, 0);
  const Outcome result = run_arguments(
      "/bin/sh", {"-c", "exec \"$0\" info \"$1\" >/dev/full", floc_program(), scratch.file("s.h5")});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("standard output: cannot be written"));
}

}  // namespace
}  // namespace floc::test
