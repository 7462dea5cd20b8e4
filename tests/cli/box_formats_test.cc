#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "floc/io/law_text.h"
#include "floc/io/state_file.h"
#include "support/box_scene.h"
#include "support/run_arguments.h"

/// A box that floc has made is exported in every format that can store it. After the file has been read again, the
/// state has equal contacts, forces and moduli.
namespace floc::test {
namespace {

using nlohmann::json;

class BoxFormats : public testing::TestWithParam<int> {
 protected:
  void make(const std::string& scene) {
    write_text(scratch_.file("box.toml"), scene);
    const Outcome made = floc_arguments({"run", scratch_.file("box.toml"), "-o", scratch_.file("out")});
    ASSERT_EQ(made.code, 0) << made.err;
    std::visit(
        [&](const auto& state) {
          law_ = law_text(state.packing.law);
          wall_law_ = law_text(state.packing.wall_law);
        },
        read_state(made_));
  }
  json row(const std::string& command, const std::string& state) {
    std::vector<std::string> arguments = {command, state, "--format", "json"};
    if (command == "moduli") arguments.emplace_back("--force");
    const Outcome o = floc_arguments(arguments);
    EXPECT_EQ(o.code, 0) << o.err;
    return o.code == 0 ? json::parse(o.out).at(0) : json();
  }
  /// Expects that `floc moduli` and `floc network` print equal numbers for the original state and for the state that
  /// was exported and converted back.
  void expect_the_same(const std::string& back) {
    for (const std::string command : {"moduli", "network"}) {
      const json before = row(command, made_), after = row(command, back);
      EXPECT_EQ(before.size(), after.size());
      for (const char* column :
           {"n_contacts", "P", "p_wall", "z", "B", "B_S", "G", "C11", "C12", "C22", "moment_2"}) {
        if (!before.contains(column)) continue;
        const double number = before.at(column).get<double>();
        EXPECT_NEAR(after.at(column).get<double>(), number, 1e-12 * std::max(1.0, std::abs(number)))
            << command << column;
      }
    }
  }
  void expect_back(const std::string& file, std::vector<std::string> more = {}) {
    SCOPED_TRACE(file);
    const std::string path = scratch_.file(file), back = scratch_.file("back.h5");
    if (!std::filesystem::exists(path)) {
      ASSERT_EQ(floc_arguments({"convert", made_, path}).code, 0);
    }
    std::vector<std::string> arguments = {"convert", path,         back,      "--law",
                                          law_,      "--wall-law", wall_law_, "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome read = floc_arguments(arguments);
    ASSERT_EQ(read.code, 0) << read.err;
    expect_the_same(back);
  }

  std::string law_, wall_law_;
  ScratchDirectory scratch_;
  const std::string made_ = scratch_.file("out/state-0001.h5");
};

/// Without friction, the positions alone determine the packing.
TEST_P(BoxFormats, OfPositionsHoldBoxesWithoutFriction) {
  std::string scene =
      exchanged(box_scene(GetParam()), "friction = {coefficient = 0.4, stiffness = 1.5e3}\n", "");
  make(exchanged(scene, "friction = 0.4\n", "friction = 0\n"));
  for (const char* file : {"box.vtu", "box.xyz", "box.data", "box.vtkhdf"}) expect_back(file);
}

TEST_P(BoxFormats, OfContactsHoldBoxesWithFriction) {
  make(box_scene(GetParam()));
  expect_back("box.vtkhdf");
  const std::string grains = scratch_.file("g.csv"), contacts = scratch_.file("c.csv");
  const Outcome o = floc_arguments({"export", made_, "--grains", grains, "--contacts", contacts});
  ASSERT_EQ(o.code, 0) << o.err;
  const std::size_t walls = o.err.find("--walls ") + 8;
  expect_back("g.csv",
              {"--contacts", contacts, "--walls", o.err.substr(walls, o.err.find(' ', walls) - walls)});
}

INSTANTIATE_TEST_SUITE_P(Dimensions, BoxFormats, testing::Values(2, 3));

}  // namespace
}  // namespace floc::test
