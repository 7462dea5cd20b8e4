#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "floc/relaxation/relaxation_options.h"
#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using testing::HasSubstr;

const std::string kDemoScene = source_directory() + "/data/scenes/demo.toml";

double group(const std::string& printed, const std::string& name) {
  for (const auto& row : nlohmann::json::parse(printed))
    if (row["group"] == name) return row["value"];
  return std::nan("");
}

TEST(SceneCheck, PrintsTheGroupsOfTheDemo) {
  const Outcome o = run_floc("scene check " + kDemoScene + " --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(group(o.out, "kappa"), 1e5);
  EXPECT_EQ(group(o.out, "h0/a"), 1e-5);
  EXPECT_EQ(group(o.out, "D0/a"), 1e-3);
  EXPECT_EQ(group(o.out, "K_T/K_N"), 1.0);
  EXPECT_NEAR(group(o.out, "K_R/(K_N a^2)"), 1e-4, 1e-19);
  EXPECT_EQ(group(o.out, "T0"), 1.0);
  // The default time step is a fraction of sqrt(m_min/K_N), with the smallest mass m_min = 1/4.
  EXPECT_NEAR(group(o.out, "time_step"), RelaxationOptions{}.time_step * 0.5 / std::sqrt(1e5), 1e-18);
  // Two equilibria at assembly (P* = 0 and 0.01), 25 on loading and 13 on unloading.
  EXPECT_EQ(group(o.out, "equilibria"), 40);
}

TEST(SceneCheck, OverridesAreSeen) {
  const Outcome o = run_floc("scene check " + kDemoScene + " --set contact.adhesion.force=2 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(group(o.out, "kappa"), 5e4);
}

TEST(SceneCheck, ListsEveryFaultAndExitsWithBadInput) {
  const ScratchDirectory dir;
  std::string text = content_of(kDemoScene);
  text.replace(text.find("stiffness = 1e5}"), 16, "stifness = 1e5}");
  text.replace(text.find("count = 400"), 11, "count = -1");
  write_text(dir.file("bad.toml"), text);
  const Outcome o = run_floc("scene check bad.toml", dir.path());
  EXPECT_EQ(o.code, 4);
  EXPECT_EQ(o.out, "");
  EXPECT_THAT(o.err,
              HasSubstr("bad.toml:13: grains.count = -1: expected the number of grains, a whole number"));
  EXPECT_THAT(o.err, HasSubstr("bad.toml:18: unknown key contact.normal.stifness"));
  EXPECT_THAT(o.err, HasSubstr("contact.normal.stiffness is missing"));
}

struct Doubtful {
  const char* change;
  const char* warning;
};

TEST(SceneCheck, WarnsOfWhatWillNotComeOutAsMeant) {
  const Doubtful scenes[] = {
      {"equilibrium.force=1e-17",
       "equilibrium.force = 1e-17: this tolerance cannot be reached in double precision"},
      {"equilibrium.moment=1e-10",
       "equilibrium.moment = 1e-10: the Newton iteration stops at a residual of 1e-08"},
      {"contact.adhesion.range=0.4",
       "contact.adhesion.range = 0.4: the range is longer than the smallest radius, 0.25"},
      {"grains.count=100000000", "days on one core"},
  };
  for (const Doubtful& scene : scenes) {
    const Outcome o = run_floc("scene check " + kDemoScene + " --set " + scene.change);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_THAT(o.err, HasSubstr(std::string("demo.toml: warning: "))) << scene.change;
    EXPECT_THAT(o.err, HasSubstr(scene.warning)) << scene.change;
    EXPECT_THAT(o.err, HasSubstr("no faults, 1 warning")) << scene.change;
  }
  const std::string direct = source_directory() + "/data/scenes/type1_no_rolling.toml";
  EXPECT_THAT(
      run_floc("scene check " + direct + " --set cell.strain_rate_cap=1e-9").err,
      HasSubstr(
          "cell.strain_rate_cap = 1e-09: at this strain rate the compression of the gas from solid_fraction"));
}

/// Scenes in which the grains move too fast for the time step, or in which the time step is too short to reach an
/// equilibrium.
TEST(SceneCheck, WarnsOfTimeStepsThatLeadNowhere) {
  struct {
    const char *scene, *changes, *warning;
  } const scenes[] = {
      {"demo", "cell.mass=1e-30", "cell.mass = 1e-30: such a light cell vibrates faster than the grains"},
      {"demo", "load.0.cell_mass=1e-20", "load.0.cell_mass = 1e-20: such a light cell"},
      {"spheres_demo", "cell.mass=1e-6", "cell.mass = 1e-06: such a light cell"},
      {"spheres_demo", "contact.normal.modulus=1e14",
       "contact.normal: relative to the load the contacts are so stiff"},
      {"spheres_demo", "assembly.pressure=0.07 --set load.0.to=0.7",
       "contact.normal: relative to the load the contacts are so stiff"},
      {"compaction_demo", "box.mass=1e-4", "box.mass = 0.0001: walls of such a small mass"},
  };
  for (const auto& [scene, changes, warning] : scenes) {
    const Outcome o =
        run_floc("scene check " + source_directory() + "/data/scenes/" + scene + ".toml --set " + changes);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_THAT(o.err, HasSubstr(warning)) << changes;
  }
}

TEST(SceneCheck, HasNothingAgainstTheShippedScenes) {
  for (const auto& entry : std::filesystem::directory_iterator(source_directory() + "/data/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const Outcome o = run_floc("scene check " + entry.path().string());
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_THAT(o.err, testing::Not(HasSubstr("warning"))) << entry.path();
  }
}

TEST(SceneCheck, PrintsTheVolumeInQuartersOfTheRangeOfSizes) {
  const std::string scene = source_directory() +
                            "/data/scenes/powder3d.toml --format json --set grains.count=300 "
                            "--set grains.diameter.min=0.1 --set ";
  const auto quarter = [&](const std::string& changes, int k) {
    return group(run_floc("scene check " + scene + changes).out, "V_" + std::to_string(k) + "/V");
  };
  const std::string by_volume = "'grains.diameter.distribution=\"uniform_by_volume\"'";
  for (int k = 1; k <= 4; ++k)
    EXPECT_NEAR(quarter(by_volume + " --set 'grains.diameter.quantiles=\"middle\"'", k), 0.25, 3.1e-3);
  EXPECT_NEAR(quarter(by_volume, 4), 0.354, 5e-4);
}

TEST(SceneCheck, TellsWhatIsDrawnFromASieveCurveBesideIt) {
  const ScratchDirectory dir;
  write_text(dir.file("sand.csv"), "size,passing\n0.05,0\n0.3,30\n1,100\n");
  std::string text = content_of(kDemoScene);
  const std::string uniform = "{distribution = \"uniform\", min = 0.5, max = 1.0}";
  text.replace(text.find(uniform), uniform.size(), "{distribution = \"sieve\", file = \"sand.csv\"}");
  write_text(dir.file("s.toml"), text);
  const Outcome o =
      run_floc("scene check s.toml --format json --sizes sizes.csv --set grains.count=20000", dir.path());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, testing::Not(HasSubstr("warning")));
  EXPECT_NEAR(group(o.out, "passing(0.3)"), 0.3, 2e-3);
  EXPECT_EQ(group(o.out, "passing(1)"), 1.0);
  EXPECT_THAT(content_of(dir.file("sizes.csv")),
              testing::StartsWith("d_from,d_to,n_grains,share,share_asked,passing,passing_asked\n0.05,0.3,"));
  // Among only 40 grains there are too few large ones to represent the size distribution. The sizes in the state must
  // be those that the command has written to the file.
  const Outcome few = run_floc("scene check s.toml --sizes few.csv --set grains.count=40", dir.path());
  EXPECT_THAT(few.err, HasSubstr("because there are too few large grains"));
  ASSERT_EQ(run_floc("run s.toml -o run --until 0 --set grains.count=40", dir.path()).code, 0);
  ASSERT_EQ(run_floc("info run/state-0000.h5 --sizes drawn.csv", dir.path()).code, 0);
  const auto row = [](const std::string& table, const std::string& before) {
    const std::size_t at = table.find(before);
    return table.substr(at, table.find('\n', at) - at);
  };
  EXPECT_EQ(row(content_of(dir.file("drawn.csv")), "0.05,0.3,"),
            row(content_of(dir.file("few.csv")), "0.05,0.3,"));
}

struct Mistake {
  const char* set;
  const char* expectation;
};

class BadScene : public testing::TestWithParam<Mistake> {};

TEST_P(BadScene, IsBadInputWithPlaceValueAndExpectation) {
  const Outcome o = run_floc("scene check " + kDemoScene + " --set '" + GetParam().set + "'");
  EXPECT_EQ(o.code, 4);
  EXPECT_EQ(o.out, "");
  EXPECT_THAT(o.err, HasSubstr(GetParam().expectation));
}

INSTANTIATE_TEST_SUITE_P(
    SceneCheck, BadScene,
    testing::Values(
        Mistake{"contact.frction.coefficient=1", "unknown key contact.frction"},
        Mistake{"contact.rolling={coefficient=1}", "contact.rolling.stiffness is missing"},
        Mistake{"grains.count=many", "grains.count = 'many': expected the number of grains, a whole number"},
        Mistake{"assembly.pressure=nan", "assembly.pressure = nan: expected a positive number"},
        Mistake{"contact.normal.stiffness=-1", "contact.normal.stiffness = -1: expected a positive number"},
        Mistake{"grains.diameter.min=2", "grains.diameter.min = 2: expected at most grains.diameter.max = 1"},
        Mistake{"cell.solid_fraction=0.9",
                "cell.solid_fraction = 0.9: expected the solid fraction of the gas in (0, 0.6]"},
        Mistake{"contact.adhesion={law=\"tail\", range=1e-3}", "contact.adhesion.force is missing"},
        Mistake{"scene.dimension=4", "scene.dimension = 4: expected 2 or 3"}));

TEST(SceneCheck, MissingFilesAndArgumentsHaveTheirOwnCodes) {
  EXPECT_EQ(run_floc("scene check no-such.toml").code, 4);
  EXPECT_EQ(run_floc("scene check").code, 2);
  EXPECT_EQ(run_floc("scene").code, 2);
}

TEST(SceneNew, WritesASceneThatIsValidAndCommented) {
  const ScratchDirectory dir;
  const Outcome o = run_floc("scene new mine", dir.path());
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string text = content_of(dir.file("mine.toml"));
  EXPECT_THAT(text, HasSubstr("name = \"mine\""));
  EXPECT_THAT(text, HasSubstr("# "));
  EXPECT_EQ(run_floc("scene check mine.toml", dir.path()).code, 0);
}

TEST(SceneNew, NeverOverwrites) {
  const ScratchDirectory dir;
  write_text(dir.file("mine.toml"), "precious");
  const Outcome o = run_floc("scene new mine", dir.path());
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("mine.toml: this file exists already"));
  EXPECT_EQ(content_of(dir.file("mine.toml")), "precious");
}

TEST(SceneNew, RefusesNamesThatNeedQuotingAndDirectoriesThatAreNotThere) {
  const ScratchDirectory dir;
  EXPECT_EQ(run_floc("scene new 'a\"b'", dir.path()).code, 4);
  EXPECT_EQ(run_floc("scene new nowhere/a", dir.path()).code, 1);
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

}  // namespace
}  // namespace floc::test
