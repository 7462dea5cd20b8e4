#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "support/small_run.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RunDirectories : public SmallRun {};

TEST_F(RunDirectories, StandForTheirStates) {
  for (const std::string command : {"moduli", "verify", "network", "structure", "info"}) {
    const std::string columns =
        command == "moduli" || command == "network" ? " --columns file,z,phi" : " --columns file";
    const Outcome of_run = floc(command + " run" + columns);
    EXPECT_EQ(of_run.code, 0) << of_run.err;
    EXPECT_EQ(of_run.out, floc(command + " run/state-*.h5" + columns).out) << command;
    EXPECT_THAT(of_run.out, HasSubstr("run/state-0008.h5")) << command;
  }
  EXPECT_EQ(floc("compare run").out, floc("compare run/state-*.h5").out);
}

TEST_F(RunDirectories, OfAnEnsembleStandForAllSamplesInOrder) {
  for (const char* seed : {"2", "10"}) {
    std::filesystem::create_directories(file(std::string("many/seed-") + seed));
    for (const char* state : {"state-0000.h5", "state-0001.h5"})
      std::filesystem::copy_file(file(std::string("run/") + state),
                                 file(std::string("many/seed-") + seed + "/" + state),
                                 std::filesystem::copy_options::overwrite_existing);
  }
  EXPECT_EQ(floc("verify many --columns file").out,
            "file\nmany/seed-2/state-0000.h5\nmany/seed-2/state-0001.h5\nmany/seed-10/state-0000.h5\n"
            "many/seed-10/state-0001.h5\n");
}

TEST_F(RunDirectories, OfEqualRunsCompareEqualWhateverTheyTook) {
  ASSERT_EQ(floc("run small.toml -o again --until 3").code, 0);
  ASSERT_EQ(floc("run small.toml -o quiet --until 3 --no-timing").code, 0);
  ASSERT_EQ(floc("run small.toml -o quieter --until 3 --no-timing").code, 0);
  EXPECT_NE(content_of(file("again/path.csv")), content_of(file("quiet/path.csv")));
  EXPECT_EQ(content_of(file("quiet/path.csv")), content_of(file("quieter/path.csv")));
  const Outcome equal = floc("compare again quiet --format json");
  EXPECT_EQ(equal.code, 0) << equal.err;
  EXPECT_THAT(equal.err, HasSubstr("equal: all 4 states are equal byte by byte, and the tables path.csv are "
                                   "equal except for the column seconds"));
  const json rows = json::parse(equal.out);
  ASSERT_EQ(rows.size(), 4u);
  for (const json& row : rows) {
    EXPECT_EQ(row.at("identical"), true);
    EXPECT_EQ(row.at("n_values"), 0);
  }
}

TEST_F(RunDirectories, OfOtherRunsSayWhereTheyPart) {
  ASSERT_EQ(floc("run small.toml -o other --until 2 --set load.0.to=2").code, 0);
  const Outcome o = floc("compare run other --format json");
  EXPECT_EQ(o.code, 5);
  EXPECT_THAT(o.err, HasSubstr("different from step 0 on"));
  const json rows = json::parse(o.out);
  ASSERT_EQ(rows.size(), 9u);
  // The two runs have different scenes. State files contain the scene, so all state files differ, even the first ones.
  // In the first row of the path, no value differs yet.
  EXPECT_EQ(rows[0].at("identical"), false);
  EXPECT_EQ(rows[1].at("n_values"), 0);
  EXPECT_TRUE(rows[8].at("after").is_null());
  // Six of the nine rows of the first run have no counterpart in the second run.
  EXPECT_THAT(o.err, HasSubstr("; of the 3 rows that both tables path.csv have, "));
}

TEST_F(RunDirectories, AreNotComparedWithADirectoryThatDoesNotExist) {
  const Outcome o = floc("compare run nodir");
  EXPECT_EQ(o.code, 4);
  EXPECT_EQ(o.out, "");
  EXPECT_THAT(o.err, HasSubstr("nodir: there is no file and no directory of this name"));
}

TEST_F(RunDirectories, ResumingAnotherSceneNamesTheKeysThatChanged) {
  const Outcome o = floc("run small.toml -o run --resume --set load.0.to=2 --set grains.count=50");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, AllOf(HasSubstr("grains.count = 50 here, = 40 there"),
                           HasSubstr("load.0.to = 2 here, = 1"), Not(HasSubstr("adhesion"))));
  write_text(file("comment.toml"), "# the same\n" + small_scene());
  EXPECT_THAT(floc("run comment.toml -o run --resume").err, HasSubstr("differ only in comments or layout"));
  EXPECT_THAT(floc("run small.toml -o run --resume --seed 8").err,
              HasSubstr("the given seed is 8, and the seed of the state is 3"));
}

TEST_F(RunDirectories, WarningsThatRepeatAreSaidOnceWithTheWorst) {
  const Outcome o = floc("moduli run --tolerance 1e-18 --columns file");
  int lines = 0;
  for (std::size_t at = 0; (at = o.err.find("above the tolerance of", at)) != std::string::npos; ++at) ++lines;
  EXPECT_EQ(lines, 1) << o.err;
  EXPECT_THAT(o.err, HasSubstr("states have this warning; this one is for the worst state)"));
  // The summary names the state with the largest error bound. This bound must be the largest of the bounds that floc
  // prints for the single states.
  double largest = 0.0;
  const std::string words = "error bound of B or G is ";
  for (int k = 0; k <= 8; ++k) {
    const std::string err = floc("moduli run/state-000" + std::to_string(k) + ".h5 --tolerance 1e-18").err;
    if (const std::size_t at = err.find(words); at != std::string::npos)
      largest = std::max(largest, std::atof(err.c_str() + at + words.size()));
  }
  EXPECT_EQ(std::atof(o.err.c_str() + o.err.find(words) + words.size()), largest);
}

}  // namespace
}  // namespace floc::test
