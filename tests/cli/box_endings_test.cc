#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "floc/io/csv.h"
#include "support/kill_and_resume.h"

namespace floc::test {
namespace {

struct BoxKind {
  std::string name;
  int dimension;
  std::string normal = "{law = \"linear\", stiffness = 1e4}";
  std::string adhesion = "";
  std::string friction = "{coefficient = 0.5, stiffness = 1e4}";
  std::string damping = "{restitution = 0.1, mass = \"effective\"}";
};

std::string capillary(const std::string& formation, const std::string& form) {
  return "adhesion = {law = \"capillary\", surface_tension = 1.0, contact_angle = 20, water_content = 0.01, "
         "density_ratio = 2.6, formation = \"" +
         formation + "\", form = \"" + form + "\"}\n";
}

std::vector<BoxKind> box_kinds() {
  const std::string tail = "adhesion = {law = \"tail\", force = 0.2, range = 1e-2}\n";
  std::vector<BoxKind> all = {
      {"dry", 2},
      {"dry", 3},
      {"tail", 2, "{law = \"linear\", stiffness = 1e3}", tail},
      {"constant", 3, "{law = \"linear\", stiffness = 1e3}", "adhesion = {law = \"constant\", force = 0.2}\n"},
      {"hertz", 3, "{law = \"hertz\", modulus = 1e4, poisson = 0.2}", "",
       "{law = \"mindlin\", coefficient = 0.5}", "{critical_fraction = 0.9}"}};
  for (const int dimension : {2, 3})
    for (const char* formation : {"gap", "contact"})
      for (const char* form : {"exponential", "rational"})
        all.push_back({std::string("wet, ") + formation + ", " + form, dimension,
                       "{law = \"linear\", stiffness = 1e4}", capillary(formation, form)});
  return all;
}

/// Scene of grains between walls, under pressures of 0.1 and then 0.3. It has no stop_time.
std::string scene_of(const BoxKind& kind) {
  const bool plane = kind.dimension == 2;
  return "[scene]\nunits = \"reduced\"\ndimension = " + std::to_string(kind.dimension) +
         "\n[grains]\ncount = 40\ndiameter = {distribution = \"uniform\", min = 0.5, max = "
         "1.0}\n[contact]\nnormal = " +
         kind.normal + "\n" + kind.adhesion + "damping = " + kind.damping + "\nfriction = " + kind.friction +
         "\n[box]\nsides = " + (plane ? "[1, 1]" : "[1, 1, 1]") +
         "\nmass = 50\npressure = 0.1\nfriction = 0.3\nadhesion = 0\n[assembly]\nprotocol = \"direct\"\n"
         "solid_fraction = 0.3\n[[load]]\nto = 0.3\nsteps = 1\n[equilibrium]\n";
}

/// If the scene gives no stop_time, no state may have the ending "stopped". The run and floc verify must find equal
/// numbers of negative eigenvalues.
TEST(BoxEndings, NoStateIsStoppedUnlessTheSceneSaysWhen) {
  const ScratchDirectory scratch;
  int n_runs = 0, n_states = 0, n_given_up = 0;
  for (const BoxKind& kind : box_kinds()) {
    const std::string what = kind.name + " in " + std::to_string(kind.dimension) + "D";
    write_text(scratch.file("box.toml"), scene_of(kind));
    const Outcome made = run_floc("run box.toml -o out --overwrite --seed 2", scratch.path());
    ++n_runs;
    n_given_up += made.code == 3;
    ASSERT_TRUE(made.code == 0 || made.code == 3) << what << ": " << made.err;
    if (made.code == 3) {
      EXPECT_THAT(made.err, testing::HasSubstr("has not settled within equilibrium.max_time")) << what;
    }
    const CsvTable path = CsvTable::read(scratch.file("out/path.csv"));
    const Outcome verified = run_floc("verify out/state-*.h5", scratch.path());
    EXPECT_EQ(verified.code, 0) << what << verified.err;
    write_text(scratch.file("verified.csv"), verified.out);
    const CsvTable found = CsvTable::read(scratch.file("verified.csv"));
    ASSERT_EQ(found.n_rows(), path.n_rows());
    for (int r = 0; r < path.n_rows(); ++r, ++n_states) {
      EXPECT_EQ(path.text(r, path.column("ending")), "dynamic") << what;
      EXPECT_EQ(path.text(r, path.column("n_negative")), found.text(r, found.column("stability"))) << what;
    }
  }
  EXPECT_EQ(n_given_up, 0);
  std::cout << n_runs << " kinds of boxes, " << n_states << " states, " << n_given_up << " given up\n";
}

/// A run with a stop_time ends with a state of the ending "stopped". If the max_time of the scene is too short, the run
/// gives up instead, and names the condition of an equilibrium that is not met.
TEST(BoxEndings, WhatDoesNotSettleIsGivenUpAndSaysWhatBlocks) {
  const ScratchDirectory scratch;
  const std::string scene = scene_of(box_kinds().front());
  write_text(scratch.file("stops.toml"), scene + "stop_time = 2\n");
  const Outcome stops = run_floc("run stops.toml -o stops", scratch.path());
  EXPECT_EQ(stops.code, 0) << stops.err;
  EXPECT_THAT(content_of(scratch.file("stops/path.csv")), testing::HasSubstr(",stopped,"));
  for (const auto& [time, blocking] :
       {std::pair("1e-3", "the forces of the grains on the walls have not yet reached half of the load"),
        {"12", "the density is not steady"}}) {
    write_text(scratch.file("short.toml"), scene + "max_time = " + time + "\n");
    const Outcome given_up = run_floc("run short.toml -o short --overwrite", scratch.path());
    EXPECT_EQ(given_up.code, 3);
    EXPECT_THAT(given_up.err, testing::HasSubstr(blocking)) << time;
    EXPECT_FALSE(std::filesystem::exists(scratch.file("short/state-0000.h5")));
  }
}

}  // namespace
}  // namespace floc::test
