#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "support/places.h"
#include "support/run_arguments.h"

/// Tests that output is written completely, or else that the command fails with a message.
namespace floc::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Output : public testing::Test {
 protected:
  Output() { EXPECT_EQ(floc_arguments({"convert", jambashbulk_file(), file("s.h5")}).code, 0); }
  std::string file(const std::string& name) const { return scratch_.file(name); }
  /// Runs a shell command in the scratch directory, with $0 set to the path of floc.
  Outcome shell(const std::string& line) const {
    return run_arguments("/bin/sh", {"-c", "cd '" + scratch_.path() + "' && " + line, floc_program()});
  }

  ScratchDirectory scratch_;
};

TEST_F(Output, ToAFullDiskIsAFailureWithItsReason) {
  for (const std::string command :
       {"info s.h5", "moduli s.h5", "verify s.h5 --format json", "network s.h5", "--help", "moduli --help",
        "--version", "draw s.h5 -o -", "convert s.h5 - --overwrite --to extended-xyz",
        "chain --n 3 --R 1 --kn 1 --kt 1 "
        "--kr 1",
        "scene new -"}) {
    const Outcome o = shell("\"$0\" " + command + " >/dev/full");
    EXPECT_EQ(o.code, 1) << command;
    EXPECT_THAT(o.err, HasSubstr("standard output: cannot be written: No space left on device")) << command;
  }
}

/// Commands that write files, with OUT in place of the name of the file. IN is the state that they read.
const std::vector<std::string>& commands_with_outputs() {
  static const std::vector<std::string> commands = {"info IN --sizes OUT",
                                                    "network IN --pdf OUT",
                                                    "network IN --particle-stress OUT",
                                                    "network IN --with bonds --exponents OUT",
                                                    "network IN --with bonds --pressure-pdf OUT",
                                                    "network IN --with bonds --like-neighbours OUT",
                                                    "network IN --with phases --clusters OUT",
                                                    "structure IN --intensity OUT",
                                                    "structure IN --pair-correlation OUT",
                                                    "structure IN --gaps OUT",
                                                    "structure IN --pores OUT",
                                                    "structure IN --map OUT",
                                                    "structure IN --porosity OUT",
                                                    "structure IN --profile OUT",
                                                    "forces IN --contacts OUT",
                                                    "moduli IN --increments OUT",
                                                    "moduli IN -o OUT",
                                                    "compare IN IN --contacts OUT",
                                                    "compare IN IN --displacements OUT",
                                                    "draw IN -o OUT",
                                                    "draw IN --compare IN -o OUT",
                                                    "plot --show forces IN -o OUT",
                                                    "export IN --grains OUT",
                                                    "export IN --contacts OUT"};
  return commands;
}

TEST_F(Output, DoesNotReplaceTheInputOrAnotherState) {
  fs::copy_file(file("s.h5"), file("other.h5"));
  const std::string before = content_of(file("s.h5"));
  for (const std::string& command : commands_with_outputs()) {
    const std::string with_input = std::regex_replace(command, std::regex("IN"), "s.h5");
    const auto run_into = [&](const std::string& name) {
      return shell("\"$0\" " + std::regex_replace(with_input, std::regex("OUT"), name));
    };
    EXPECT_EQ(run_into("new.svg").code, 0) << command;
    for (const std::string name : {"s.h5", "./s.h5", "other.h5"}) {
      const Outcome o = run_into(name);
      EXPECT_EQ(o.code, 4) << command << " " << name << o.err;
      EXPECT_THAT(o.err, HasSubstr("expected")) << command << " " << name;
      EXPECT_TRUE(content_of(file("s.h5")) == before && content_of(file("other.h5")) == before) << command;
    }
  }
}

TEST_F(Output, DoesNotReplaceAScene) {
  const std::string scene = content_of(source_directory() + "/data/scenes/demo.toml");
  for (const std::string command :
       {"scene check mine.toml --sizes mine.toml", "plan mine.toml --budget 10s -o mine.toml"}) {
    write_text(file("mine.toml"), scene);
    const Outcome o = shell("\"$0\" " + command);
    EXPECT_EQ(o.code, 4) << command;
    EXPECT_THAT(o.err, HasSubstr("mine.toml: this file is an input of the command")) << command;
    EXPECT_EQ(content_of(file("mine.toml")), scene) << command;
  }
}

TEST_F(Output, OfTwoKindsDoesNotGoToOneFile) {
  for (const std::string command :
       {"network s.h5 --pdf one --particle-stress ./one", "structure s.h5 --gaps one --profile one",
        "export s.h5 --grains one --contacts one"}) {
    fs::remove(file("one"));
    const Outcome o = shell("\"$0\" " + command);
    EXPECT_EQ(o.code, 4) << command << o.err;
    EXPECT_THAT(o.err, HasSubstr("one: the command has already written another of its outputs to this file"))
        << command;
  }
  EXPECT_EQ(shell("\"$0\" network s.h5 --pdf /dev/null --particle-stress /dev/null").code, 0);
}

TEST_F(Output, OfACommandThatFailsLeavesAnOlderFile) {
  for (const std::string command :
       {"structure none.h5 --profile old.csv", "network none.h5 --pdf old.csv",
        "forces none.h5 --contacts old.csv", "moduli none.h5 --increments old.csv",
        "info none.h5 --sizes old.csv", "compare none.h5 none.h5 --contacts old.csv",
        "export none.h5 --grains old.csv"}) {
    write_text(file("old.csv"), "old\n");
    EXPECT_NE(shell("\"$0\" " + command).code, 0) << command;
    EXPECT_EQ(content_of(file("old.csv")), "old\n") << command;
  }
}

TEST_F(Output, OfSideTablesIsWholeOrAbsentAndItsReasonSaid) {
  // The limit of the file size also applies to the file that receives the standard error, so the limit must exceed the
  // size of the warnings.
  ASSERT_EQ(floc_arguments({"convert", source_directory() + "/data/packings/lammps/disks.dump",
                            file("disks.h5"), "--law", "normal.stiffness=1000"})
                .code,
            0);
  for (const std::string command :
       {"moduli --force disks.h5 --increments side.csv", "network disks.h5 --particle-stress side.csv",
        "structure disks.h5 --pair-correlation side.csv", "convert disks.h5 side.csv.xyz"}) {
    const Outcome o = shell("ulimit -f 2; \"$0\" " + command + " >/dev/null");
    EXPECT_EQ(o.code, 1) << command << o.err;
    EXPECT_THAT(o.err, HasSubstr("cannot be written: File too large")) << command;
    for (const std::string left : {"side.csv", "side.csv.part", "side.csv.xyz", "side.csv.xyz.part"})
      EXPECT_FALSE(fs::exists(file(left))) << command << " " << left;
  }
}

TEST_F(Output, ToADashIsStdoutOrRefusedAndNeverAFileOfThatName) {
  EXPECT_THAT(shell("\"$0\" convert s.h5 - --to extended-xyz").out, StartsWith("16\n"));
  EXPECT_THAT(shell("\"$0\" draw s.h5 -o - --as svg").out, HasSubstr("<svg"));
  EXPECT_THAT(shell("\"$0\" scene new -").out, HasSubstr("[grains]"));
  for (const std::string command :
       {"moduli s.h5 --increments -", "network s.h5 --pdf -", "network s.h5 --particle-stress -",
        "structure s.h5 --map -", "compare s.h5 s.h5 --displacements -"}) {
    const Outcome o = shell("\"$0\" " + command);
    EXPECT_EQ(o.code, 4) << command;
    EXPECT_THAT(o.err,
                HasSubstr("this name means standard output, which already receives the first table of this "
                          "command: expected the name of a file"))
        << command;
  }
  for (const std::string command :
       {"convert s.h5 -", "plot s.h5 -o - --show forces", "report - -o -", "fit consolidation s.h5 --plot -"})
    EXPECT_NE(shell("\"$0\" " + command).code, 0) << command;
  for (const auto& entry : fs::directory_iterator(scratch_.path()))
    EXPECT_FALSE(entry.path().filename().string().starts_with("-")) << entry.path();
}

TEST_F(Output, ToADeviceOrAPipeIsWrittenAndLeavesItWhatItIs) {
  const Outcome o = shell(
      "mkfifo pipe; cat pipe > copy & \"$0\" network s.h5 --particle-stress pipe >/dev/null; wait; "
      "test -p pipe; echo $?");
  EXPECT_EQ(o.out, "0\n");
  EXPECT_THAT(content_of(file("copy")), StartsWith("file,"));
}

}  // namespace
}  // namespace floc::test
