#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "floc/base/error.h"
#include "floc/imports/complete_import.h"
#include "floc/packing/balance.h"
#include "floc/packing/locate.h"
#include "floc/packing/wall_forces.h"
#include "floc/rigid/static_forces.h"
#include "support/foreign_packing.h"

/// Tests with files of other programs that are not part of the repository. The environment variable FLOC_FOREIGN_DATA
/// names the folder of the files (CONTRIBUTING.md); without it the tests are skipped. The expected numbers were read
/// from the files by other parsers.
namespace floc {
namespace {

class ForeignData : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("FLOC_FOREIGN_DATA");
    if (!folder) GTEST_SKIP() << "FLOC_FOREIGN_DATA is not set";
    folder_ = folder;
  }
  /// Reads a file like `floc convert`.
  template <int Dim>
  State<Dim> read(const std::string& file, ImportOptions options = {}) {
    const std::string path = (folder_ / file).string();
    if (!options.law) options.law = parse_law("law", test::kForeignLaw);
    const Imported imported = find_import_format("", path).read(path, options);
    auto state = std::get<State<Dim>>(imported.state);
    complete_import(path, imported, {}, state);
    return state;
  }

  std::filesystem::path folder_;
};

TEST_F(ForeignData, ColumnsOfMercuryDpmStandOnTheFloor) {
  const State<3> state = read<3>("mercurydpm/CubicPackingSelfTest.restart");
  const Packing<3>& p = state.packing;
  EXPECT_EQ(p.grains.size(), 125);
  EXPECT_EQ(p.contacts.size(), 125u);
  EXPECT_EQ(p.walls.size(), 6u);
  EXPECT_EQ(p.gravity, Vec<3>(0.0, 0.0, -1.0));
  EXPECT_NEAR(wall_forces(p)[4], 142.116248235575, 1e-9);
  EXPECT_EQ(wall_forces(p)[5], 0.0);
}

TEST_F(ForeignData, DisksOfMercuryDpmCarryTheirWeight) {
  const State<2> state = read<2>("mercurydpm/SquarePackingSelfTest.restart");
  EXPECT_EQ(state.packing.grains.size(), 25);
  EXPECT_NEAR(wall_forces(state.packing)[2], 25.0, 2e-3);
  EXPECT_LT(state.residuals.force, 1e-4);
}

TEST_F(ForeignData, LeesEdwardsCellIsASkewedOne) {
  const State<2> state = read<2>("mercurydpm/LeesEdwardsSelfTest.restart");
  EXPECT_EQ(state.packing.grains.size(), 233);
  EXPECT_EQ(state.packing.contacts.size(), 319u);
  EXPECT_NEAR(state.stress.trace() / 2.0, 44.81344, 5e-6);
  EXPECT_NEAR(state.packing.cell.matrix(1, 0), 0.015, 1e-9);
}

TEST_F(ForeignData, AngledCellIsAnOpenPackingWithTheForcesOfTheFile) {
  ImportOptions options;
  options.law =
      parse_law("law",
                "normal.stiffness=1000,adhesion.law=constant,adhesion.force=100,friction.coefficient=0.5,"
                "friction.stiffness=800");
  const State<2> state = read<2>("mercurydpm/ShearCell2DSelfTest.restart", options);
  EXPECT_EQ(state.packing.grains.size(), 75);
  EXPECT_EQ(state.packing.contacts.size(), 142u);
  EXPECT_TRUE(is_open_along(state.packing.walls, 0));
}

TEST_F(ForeignData, FstatOfAChuteListsItsPairsTwice) {
  ImportOptions options;
  options.contacts = (folder_ / "mercurydpm/chute_periodic.fstat").string();
  options.pairs_twice = true;
  options.drop_tensile = true;
  const State<3> state = read<3>("mercurydpm/chute_periodic.restart", options);
  EXPECT_EQ(state.packing.grains.size(), 107);
  // The 171 rows contain 92 pairs. One of the pairs has an attractive force and is left out. For the other pairs, the
  // sum of force times branch does not depend on the position of the free end.
  EXPECT_EQ(state.packing.contacts.size(), 91u);
  EXPECT_NEAR(state.stress.trace() / 3.0 * state.packing.cell.volume(), 3.1817834280059e-06, 1e-18);
  EXPECT_FALSE(between_walls(state.packing.walls, 0));
  EXPECT_TRUE(is_open_along(state.packing.walls, 2));
}

TEST_F(ForeignData, DisksOfLmgc90AreReadBeforeTheyTouch) {
  const State<2> state = read<2>("lmgc90/1024DK_BoxJC");
  EXPECT_EQ(state.packing.grains.size(), 1024);
  EXPECT_EQ(state.packing.contacts.size(), 0u);
  EXPECT_EQ(state.packing.gravity, Vec<2>(0.0, -9.81));
}

TEST_F(ForeignData, SpheresOfRockableAreReadBeforeTheyTouch) {
  const State<3> state = read<3>("rockable/iso_spheres_periodic/input.txt");
  EXPECT_EQ(state.packing.grains.size(), 125);
  EXPECT_EQ(state.packing.contacts.size(), 0u);
  EXPECT_NEAR(solid_fraction(state.packing), 0.26808, 5e-6);
}

TEST_F(ForeignData, PolyhedraOfRockableCarryTheImposedPressure) {
  const State<3> state = read<3>("rockable/518_poly/518_poly_bruteforce_default_noperiod.conf");
  const Packing<3>& p = state.packing;
  EXPECT_EQ(p.grains.size(), 512);
  EXPECT_EQ(p.contacts.size(), 3867u);
  EXPECT_EQ(p.walls.size(), 6u);
  for (int a = 0; a < 3; ++a)
    EXPECT_NEAR(state.stress(a, a), 0.015, 3e-8);  // the stress control in the file imposes 0.015
  EXPECT_LT(state.residuals.force, 2.4e-4);
  std::map<std::pair<int, int>, double> force;
  for (const Contact<3>& c : p.contacts) force[{c.i, c.j}] += c.normal_force;
  EXPECT_EQ(force.size(), 1758u);
}

/// Returns the message with which no balanced forces of a packing are found; empty if they are found.
template <int Dim>
std::string unbalanced(const Packing<Dim>& packing) {
  try {
    StaticForces<Dim> forces("the file", packing, {});
    EXPECT_LT(forces.closest().error.force, 1e-9);
  } catch (const NoResult& reason) {
    return reason.what();
  }
  return "";
}

TEST_F(ForeignData, ForcesBalanceOrGrainsAreNamed) {
  // The forces in the file of Rockable, which are without friction, balance to 2.4e-4 of their mean and no better; with
  // friction, there are forces that balance. The file of LMGC90 lacks the contacts with the floor.
  const std::string file = "rockable/518_poly/518_poly_bruteforce_default_noperiod.conf";
  EXPECT_EQ(unbalanced(read<3>(file).packing), "");
  ImportOptions options;
  options.law = parse_law("law", "normal.law=rigid");
  EXPECT_THAT(unbalanced(read<3>(file, options).packing), testing::ContainsRegex("grains [0-9]+, [0-9]+"));
  options.law = parse_law("law", "normal.law=rigid,friction.coefficient=0.4");
  options.cell = {{1.1, 0.0}, {0.0, 0.7}};
  options.walls = "y=0:0.7";
  const State<2> pentagons = read<2>("lmgc90/500PL_PerioBoxJC", options);
  EXPECT_THAT(unbalanced(pentagons.packing), testing::ContainsRegex("the load moves most grain"));
}

TEST_F(ForeignData, PentagonsOfLmgc90Balance) {
  ImportOptions options;
  options.law = parse_law("law", "normal.law=rigid,friction.coefficient=0.4");
  options.cell = {{1.1, 0.0}, {0.0, 0.7}};
  options.walls = "y=0:0.7";
  const State<2> state = read<2>("lmgc90/500PL_PerioBoxJC", options);
  const Packing<2>& p = state.packing;
  EXPECT_EQ(p.grains.size(), 500);
  EXPECT_EQ(p.contacts.size(), 922u);
  std::map<std::pair<int, int>, int> points;
  double sum = 0.0;
  for (const Contact<2>& c : p.contacts) ++points[{c.i, c.j}], sum += c.normal_force;
  EXPECT_EQ(points.size(), 793u);
  EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const auto& pair) { return pair.second == 2; }),
            129);
  // The file does not contain contacts with the floor, so the forces on some grains do not balance.
  const Balance<2> balance = net_forces(p);
  const double mean = sum / 922.0;
  int n_balanced = 0;
  for (int i = 0; i < 500; ++i) n_balanced += balance.force[i].norm() < 1e-5 * mean;
  EXPECT_GE(n_balanced, 448);
  // The contact points computed from the shapes agree with the contact points in the file to the seven digits of the
  // file.
  double furthest = 0.0;
  for (const Contact<2>& c : p.contacts) furthest = std::max(furthest, std::abs(locate(p, c).gap - c.gap));
  EXPECT_LT(furthest, 5e-5);
}

}  // namespace
}  // namespace floc
