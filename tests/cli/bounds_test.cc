#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/box_scene.h"
#include "support/run_arguments.h"
#include "support/wet_scene.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string shipped(const std::string& scene) {
  return source_directory() + "/data/scenes/" + scene + ".toml --set grains.count=40 ";
}

/// Kind of states, and the arguments for `floc run` that produce such states.
struct StateKind {
  const char* name;
  std::string scene;
};

std::vector<StateKind> state_kinds() {
  return {{"cohesive disks", shipped("type1_rolling_small") + "--set load.0.steps_per_decade=2 --until 9"},
          {"cohesive disks, distant bonds", shipped("type1_no_rolling") +
                                                "--set contact.adhesion.range=0.05 --set load.0.to=1 "
                                                "--set load.0.steps_per_decade=2 --until 5"},
          {"disks without adhesion", shipped("cohesionless_cycle") + "--until 5"},
          {"disks under a deviator", shipped("biaxial_dense") + "--until 14"},
          {"disks in an oedometer", shipped("oedometer") + "--until 7"},
          {"beads, Hertz", shipped("spheres_demo") + "--until 4"},
          {"cohesive spheres", shipped("powder3d") + "--until 4"},
          {"wet beads", "wet.toml"},
          {"wet beads pulled apart",
           source_directory() + "/data/scenes/wet_tension.toml --set grains.count=40 --until 6"},
          {"box of disks", "box2.toml"},
          {"box of spheres", "box3.toml"}};
}

double number(const json& row, const char* name) {
  return row.at(name).is_null() ? std::nan("") : row.at(name).get<double>();
}

/// Numbers of states in which the bounds of the moduli are valid (hold), are also valid for B_S, or are refused.
struct Coverage {
  int hold = 0, hold_B_S = 0, refused = 0;
};

/// Relative tolerance of the bounds. Forces are balanced only to 1e-5, so B_reuss may exceed a modulus by this
/// fraction.
constexpr double kSlack = 1e-5;

/// Checks that the moduli of a state lie within their bounds. Also checks that they agree with the estimates of the
/// method `bounds`, within the errors of these estimates.
void check_state(const std::string& what, const json& exact, const json* by_bounds, Coverage& covered) {
  const double B = number(exact, "B"), B_S = number(exact, "B_S"), G = number(exact, "G");
  const bool hold = exact.at("bounds_hold"), hold_B_S = exact.at("bounds_hold_B_S");
  EXPECT_FALSE(hold_B_S && !hold) << what;
  for (const char* error : {"error_B", "error_B_S", "error_G"}) EXPECT_GE(number(exact, error), 0.0) << what;
  EXPECT_TRUE(exact.at("B_reuss").is_number()) << what;
  if (!hold) {
    ++covered.refused;
    EXPECT_EQ(by_bounds, nullptr) << what;
    return;
  }
  ++covered.hold;
  EXPECT_EQ(number(exact, "n_distant"), 0.0) << what;
  EXPECT_LE(number(exact, "B_reuss"), (1.0 + kSlack) * B) << what;
  EXPECT_LE((1.0 - kSlack) * B, number(exact, "B_voigt")) << what;
  EXPECT_LE((1.0 - kSlack) * G, number(exact, "G_voigt")) << what;
  ASSERT_NE(by_bounds, nullptr) << what;
  EXPECT_TRUE(by_bounds->at("bounds_hold")) << what;
  EXPECT_EQ(by_bounds->at("bounds_hold_B_S"), hold_B_S) << what;
  const auto expect_within = [&](const char* name, const char* error, double value) {
    EXPECT_GE(number(*by_bounds, error), 0.0) << what;
    EXPECT_LE(std::abs(number(*by_bounds, name) - value), number(*by_bounds, error) + kSlack * value)
        << what << ": " << name;
  };
  expect_within("B", "error_B", B);
  expect_within("G", "error_G", G);
  if (!hold_B_S) {
    EXPECT_TRUE(by_bounds->at("B_S").is_null() && by_bounds->at("error_B_S").is_null()) << what;
    return;
  }
  ++covered.hold_B_S;
  EXPECT_LE(number(exact, "B_reuss"), (1.0 + kSlack) * B_S) << what;
  expect_within("B_S", "error_B_S", B_S);
}

/// Checks every state of a run.
/// @param options  options of `floc moduli`
void check_run(const ScratchDirectory& scratch, const std::string& run, const std::string& options,
               Coverage& covered) {
  const auto moduli = [&](const std::string& method) {
    return run_floc("moduli " + run + " --format json" + options + method, scratch.path());
  };
  const Outcome exact = moduli(""), bounds = moduli(" --method bounds");
  ASSERT_EQ(exact.code, 0) << exact.err;
  std::map<std::string, json> of_bounds;
  for (const json& row : json::parse(bounds.out)) of_bounds[row.at("file")] = row;
  const Coverage before = covered;
  for (const json& row : json::parse(exact.out)) {
    const auto found = of_bounds.find(row.at("file"));
    check_state(row.at("file").get<std::string>() + options, row,
                found == of_bounds.end() ? nullptr : &found->second, covered);
  }
  const bool refused = covered.refused > before.refused;
  EXPECT_EQ(bounds.code, refused ? 4 : 0) << run << options << ": " << bounds.err;
  if (!refused) return;
  EXPECT_THAT(exact.err, HasSubstr("B_reuss and B_voigt do not bound B, because")) << run << options;
  EXPECT_THAT(bounds.err, HasSubstr("--method bounds cannot be applied to this state: ")) << run << options;
}

TEST(BoundsOfModuli, HoldWhereTheColumnSaysSoAndAreRefusedElsewhere) {
  const ScratchDirectory scratch;
  write_text(scratch.file("wet.toml"), wet_scene());
  write_text(scratch.file("box2.toml"), box_scene(2));
  write_text(scratch.file("box3.toml"), box_scene(3));
  std::map<std::string, Coverage> covered;
  int k = 0;
  for (const StateKind& kind : state_kinds()) {
    const std::string run = fmt::format("run{}", k++);
    const Outcome made = run_floc("run " + kind.scene + " -o " + run, scratch.path());
    ASSERT_EQ(made.code, 0) << kind.name << ": " << made.err;
    const bool box = std::string(kind.name).starts_with("box");
    check_run(scratch, run, "", covered[kind.name]);
    check_run(scratch, run, " --prestress", covered["with prestress"]);
    if (!box) check_run(scratch, run, " --strains full", covered[kind.name]);
  }
  for (const auto& [kind, c] : covered)
    fmt::print("{}: bounds hold in {} rows, of B_S too in {}; none and refused in {}\n", kind, c.hold,
               c.hold_B_S, c.refused);
  EXPECT_EQ(covered["with prestress"].hold, 0);
  for (const char* kind : {"cohesive disks, distant bonds", "wet beads", "wet beads pulled apart"})
    EXPECT_GT(covered[kind].refused, 0) << kind;
  for (const char* kind : {"disks under a deviator", "disks in an oedometer"})
    EXPECT_GT(covered[kind].hold, covered[kind].hold_B_S) << kind;
  for (const StateKind& kind : state_kinds())
    EXPECT_GT(covered[kind.name].hold + covered[kind.name].refused, 0);
}

/// A square lattice with contacts of stiffness 1 along one axis and 1000 along the other. The stresses on the two axes
/// have the same ratio. B_reuss equals B = 250.25, far above B_S = 1/(1/1 + 1/1000).
TEST(BoundsOfModuli, DoNotTellB_SUnderADeviator) {
  const ScratchDirectory scratch;
  write_text(scratch.file("g.csv"), "id,x,y,r\n0,0,0,0.5\n1,0.999,0,0.5\n2,0,0.999,0.5\n3,0.999,0.999,0.5\n");
  write_text(scratch.file("c.csv"),
             "id1,id2,image1,image2,normal_force,kn,kt\n0,1,0,0,0.001,1,1\n0,1,-1,0,0.001,1,1\n"
             "2,3,0,0,0.001,1,1\n2,3,-1,0,0.001,1,1\n0,2,0,0,1,1000,1\n0,2,0,-1,1,1000,1\n"
             "1,3,0,0,1,1000,1\n1,3,0,-1,1,1000,1\n");
  ASSERT_EQ(
      run_floc("convert g.csv s.h5 --columns radius=r --cell '1.998,0;0,1.998' --law normal.stiffness=1000,"
               "friction.coefficient=0.5,friction.stiffness=1 --contacts c.csv",
               scratch.path())
          .code,
      0);
  const auto row = [&](const std::string& options) {
    const Outcome o = run_floc("moduli s.h5 --format json" + options, scratch.path());
    EXPECT_EQ(o.code, 0) << o.err;
    return std::pair{json::parse(o.out).at(0), o.err};
  };
  const auto [bounds, said] = row(" --method bounds");
  EXPECT_NEAR(number(bounds, "B"), 250.25, 1e-9);
  EXPECT_TRUE(bounds.at("B_S").is_null() && bounds.at("error_B_S").is_null());
  EXPECT_THAT(said, HasSubstr("B_S is not given: B_reuss bounds it only if the principal stresses are equal"));
  const auto [exact, warned] = row("");
  EXPECT_NEAR(number(exact, "B_S"), 1.0 / 1.001, 1e-9);
  EXPECT_THAT(warned, HasSubstr("B_reuss = 250.25 exceeds B_S = 0.999001: B_reuss bounds B but not B_S"));
}

TEST(BoundsOfModuli, AreNotDrawnWhereTheyDoNotHold) {
  const ScratchDirectory scratch;
  write_text(scratch.file("wet.toml"), wet_scene());
  ASSERT_EQ(run_floc("run wet.toml -o wet", scratch.path()).code, 0);
  ASSERT_EQ(run_floc("moduli wet --format csv -o wet.csv", scratch.path()).code, 0);
  for (const std::string input : {"wet", "wet.csv"}) {
    ASSERT_EQ(run_floc("plot " + input + " --show moduli -o p.svg", scratch.path()).code, 0);
    std::istringstream lines(content_of(scratch.file("p.dat")));
    int n_bounded = 0, n_unbounded = 0;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string cell[7];
      for (std::string& word : cell) words >> word;
      if (cell[6].empty() || cell[0] == "#" || cell[1] == "nan" || cell[1] == "NaN") continue;
      const bool none = cell[4] == "nan" || cell[4] == "NaN";
      EXPECT_EQ(cell[5], none ? cell[4] : cell[5]);
      (none ? n_unbounded : n_bounded) += 1;
    }
    EXPECT_GT(n_bounded, 0) << input;
    EXPECT_GT(n_unbounded, 0) << input;
  }
}

}  // namespace
}  // namespace floc::test
