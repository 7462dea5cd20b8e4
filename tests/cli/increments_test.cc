#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "floc/io/state_file.h"
#include "floc/neighbors/find_contacts.h"
#include "support/lattices.h"
#include "support/run_arguments.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

/// Returns the rows of a csv file, each as a list of fields.
std::vector<std::vector<std::string>> rows_of(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream lines(path);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

/// Fixture: a saved equilibrium of disks in a square lattice under isotropic pressure, with K_N = 2.
class Increments : public testing::Test {
 protected:
  void SetUp() override {
    State<2> square;
    square.packing = square_frames(2, 1.0, elastic_law(2.0, 0.6, 0.1));
    write_state(scratch_.file("square.h5"), square);
    State<3> cubic;
    cubic.packing.law = elastic_law(2.0, 0.6, 0.1);
    cubic.packing.grains = Grains<3>::with_size(1);
    cubic.packing.grains.radius = {0.51};
    cubic.packing.grains.mass = {1.0};
    find_contacts(cubic.packing);
    write_state(scratch_.file("cubic.h5"), cubic);
    State<2> chain;
    chain.packing = chain_across(4, 1.0, 3.0, elastic_law(1.0, 0.5, 0.1));
    write_state(scratch_.file("chain.h5"), chain);
  }
  Outcome moduli(const std::string& arguments) const {
    return run_floc("moduli --force " + arguments, scratch_.path());
  }
  std::vector<std::vector<std::string>> written() const { return rows_of(scratch_.file("out.csv")); }

  ScratchDirectory scratch_;
};

TEST_F(Increments, OfASquareLatticeAreThoseOfItsTwoContacts) {
  const Outcome o = moduli("square.h5 --increments out.csv --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto rows = written();
  ASSERT_THAT(rows, SizeIs(3));
  EXPECT_THAT(rows[0],
              ElementsAre("file", "contact", "id1", "id2", "image1", "image2", "distant", "isotropic_normal",
                          "isotropic_shear1", "isotropic_shear2", "isotropic_rolling", "isotropic_energy",
                          "isotropic_rank", "isotropic_in_95", "deviatoric_normal", "deviatoric_shear1",
                          "deviatoric_shear2", "deviatoric_rolling", "deviatoric_energy", "deviatoric_rank",
                          "deviatoric_in_95", "dead_end", "backbone", "scalar_backbone"));
  for (int k = 1; k <= 2; ++k) {
    EXPECT_EQ(rows[k][0], "square.h5");
    EXPECT_NEAR(std::stod(rows[k][7]), 1.0, 1e-12);    // a unit stress on a unit length exerts a unit force
    EXPECT_NEAR(std::stod(rows[k][11]), 0.25, 1e-12);  // a unit force stores the energy 1/(2 K_N)
    EXPECT_EQ(rows[k][21], "false");
    EXPECT_EQ(rows[k][22], "true");
    EXPECT_EQ(rows[k][23], "true");
  }
  EXPECT_NEAR(std::stod(rows[1][14]) * std::stod(rows[2][14]), -1.0, 1e-12);
  const json row = json::parse(o.out).at(0);
  EXPECT_EQ(row.at("z_star"), 4.0);
  EXPECT_EQ(row.at("x0"), 0.0);
  EXPECT_EQ(row.at("n_percolating"), 2);
  EXPECT_EQ(row.at("n_components"), 1);
  EXPECT_EQ(row.at("energy_share_95"), 1.0);
  EXPECT_EQ(row.at("scalar_backbone_share"), 1.0);
  const json full = json::parse(moduli("square.h5 --strains full --format json").out).at(0);
  EXPECT_EQ(full.at("indeterminacy"), row.at("indeterminacy"));
  EXPECT_EQ(full.at("energy_share_95"), row.at("energy_share_95"));
  // The degree of indeterminacy is 2 contacts times 3 force components, minus 3 unknowns of the grain, minus 2 strains,
  // plus 2 translations.
  EXPECT_EQ(row.at("indeterminacy"), 3);
  // The modulus is G = K_N/2 r^2/A, with the squared branch length r^2 and the area A of the cell; G_star =
  // G/(K_N Phi).
  EXPECT_NEAR(row.at("G_star").get<double>(), 0.5 / row.at("phi").get<double>(), 1e-12);
}

TEST_F(Increments, OfManyStatesStandInOneFile) {
  ASSERT_EQ(moduli("square.h5 chain.h5 square.h5 --increments out.csv").code, 0);
  const auto rows = written();
  ASSERT_THAT(rows, SizeIs(1 + 2 + 4 + 2));
  EXPECT_EQ(rows[3][0], "chain.h5");
  EXPECT_EQ(rows[3][7], "");  // with a mechanism, no response to the stress exists
  EXPECT_EQ(rows[8][0], "square.h5");
}

TEST_F(Increments, OfSpheresHaveThreeComponents) {
  ASSERT_EQ(moduli("cubic.h5 --increments out.csv").code, 0);
  const auto rows = written();
  ASSERT_THAT(rows, SizeIs(4));
  EXPECT_THAT(rows[0], SizeIs(33));
  for (int k = 1; k <= 3; ++k) EXPECT_NEAR(std::stod(rows[k][8]), 1.0, 1e-12);
}

TEST_F(Increments, AreRefusedInWordsWhereOneFileCannotHoldThem) {
  const Outcome mixed = moduli("square.h5 cubic.h5 --increments out.csv");
  EXPECT_EQ(mixed.code, 4);
  EXPECT_THAT(mixed.err, HasSubstr("cubic.h5: this state differs in dimension from the states before it"));
  EXPECT_THAT(written(), SizeIs(3));
  const Outcome several = moduli("square.h5 --increments out.csv --rolling-stiffness 1,2");
  EXPECT_EQ(several.code, 4);
  EXPECT_THAT(several.err, HasSubstr("--increments: expected at most one value of --rolling-stiffness"));
  EXPECT_EQ(moduli("square.h5 --increments none/out.csv").code, 1);
}

TEST_F(Increments, OfRattlersAreNone) {
  // A disk with only one contact, without adhesion, is a rattler.
  State<2> state;
  state.packing = square_frames_around({{2.0, 1.0}}, 5, 1.0, elastic_law(1.0, 0.6, 0.1));
  write_state(scratch_.file("rattler.h5"), state);
  const Outcome o = moduli("rattler.h5 --increments out.csv --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json row = json::parse(o.out).at(0);
  EXPECT_EQ(row.at("x0").get<double>(), 1.0 / 8.0);
  EXPECT_EQ(row.at("z_star").get<double>(), 2.0 * 8.0 / 7.0);
  const auto rows = written();
  ASSERT_THAT(rows, SizeIs(1 + 8 + 1));
  int n_unchanged = 0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if (rows[k][2] != "7" && rows[k][3] != "7") continue;
    ++n_unchanged;
    EXPECT_EQ(std::stod(rows[k][7]), 0.0);
    EXPECT_EQ(rows[k][12], "");
    EXPECT_EQ(rows[k][21], "true");
    EXPECT_EQ(rows[k][22], "false");
  }
  EXPECT_EQ(n_unchanged, 1);
}

TEST_F(Increments, StateWithAMechanismNamesTheModuliThatVanish) {
  const Outcome o = moduli("chain.h5 --format json");
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(
      o.err, HasSubstr("chain.h5: warning: mechanisms let the cell change its shape without elastic energy, so "
                       "these moduli are zero: C22, B_S"));
  const json row = json::parse(o.out).at(0);
  EXPECT_TRUE(row.at("energy_share_95").is_null());
  EXPECT_EQ(row.at("n_percolating"), 1);
}

}  // namespace
}  // namespace floc::test
