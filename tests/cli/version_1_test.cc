#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/run_arguments.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string version_1(const std::string& name) {
  return source_directory() + "/tests/regression/version_1/" + name;
}

/// floc verify and floc moduli need the spring elongations that the file stores.
TEST(FilesOfVersion1, AreVerifiedAndGiveTheirModuli) {
  EXPECT_EQ(floc_arguments({"verify", version_1("state-0003.h5")}).code, 0);
  const Outcome moduli = floc_arguments({"moduli", version_1("state-0003.h5"), "--format", "json"});
  ASSERT_EQ(moduli.code, 0) << moduli.err;
  const auto row = nlohmann::json::parse(moduli.out).at(0);
  EXPECT_EQ(row["B"], 3090.764436149915);
  EXPECT_EQ(row["G"], 2960.1271741368982);
  EXPECT_EQ(row["B_reuss"], 103.07370580138802);
  EXPECT_EQ(row["Z2"], 234.12293934761652);
}

TEST(FilesOfVersion1, ThatAreCheckpointsAreRefusedInWords) {
  const ScratchDirectory scratch;
  fs::create_directories(scratch.file("run/checkpoint"));
  fs::copy(version_1("checkpoint.h5"), scratch.file("run/checkpoint/checkpoint.h5"));
  const Outcome resumed = run_floc("run " + version_1("scene.toml") + " -o run --resume", scratch.path());
  EXPECT_EQ(resumed.code, 4);
  EXPECT_THAT(resumed.err,
              HasSubstr("checkpoint.h5:/progress: the checkpoint has version 1 of the file format"));
  EXPECT_THAT(resumed.err, HasSubstr("remove the checkpoint to continue from the last equilibrium saved"));
}

}  // namespace
}  // namespace floc::test
