#include "floc/io/wall_planes.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "floc/base/error.h"
#include "floc/io/settle_space.h"
#include "support/run_program.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Returns two grains, one at (1, 1, 1) and one at (2, 2, 2).
std::vector<ListedGrain> two_grains() {
  std::vector<ListedGrain> grains(2);
  for (std::size_t k = 0; k < 2; ++k) {
    grains[k].id = static_cast<std::int64_t>(k);
    grains[k].position.setConstant(1.0 + static_cast<double>(k));
    grains[k].radius = 0.5;
  }
  return grains;
}

std::string in_words(const std::vector<ListedEnds>& all) {
  std::string words;
  for (const ListedEnds& e : all)
    words += fmt::format("{}={}:{} ", "xyz"[e.axis], e.low ? fmt::format("{}", *e.low) : "",
                         e.high ? fmt::format("{}", *e.high) : "");
  return words;
}

class WallFile : public testing::Test {
 protected:
  std::string walls(const std::string& text) {
    test::write_text(scratch_.file("in.walls"), text);
    return in_words(ends_of_planes(read_wall_file(scratch_.file("in.walls")).planes, two_grains(), 3));
  }
  void refused(const std::string& text, const std::string& words) {
    EXPECT_THAT([&] { walls(text); }, ThrowsMessage<InputError>(HasSubstr(words))) << text;
  }
  void write_triangle(const std::string& corners) {
    std::string text = "solid s\nfacet normal 0 0 1\nouter loop\n";
    std::istringstream in(corners);
    for (std::string corner; std::getline(in, corner, ';');) text += "vertex " + corner + "\n";
    test::write_text(scratch_.file("s.stl"), text + "endloop\nendfacet\nendsolid s\n");
  }

  test::ScratchDirectory scratch_;
};

TEST_F(WallFile, OfLammpsHasThePlanesOfItsFixes) {
  EXPECT_EQ(walls("fix w all wall/gran hooke 1 2 3 4 0.5 1 xplane 0 3.5 contacts\n"), "x=0:3.5 ");
  EXPECT_EQ(walls("fix a all wall/gran granular hertz 1 2 tangential mindlin 1 2 3 zplane 0.1 NULL # floor\n"),
            "z=0.1: ");
  EXPECT_EQ(walls("variable h equal 4\nvariable l index -1\nfix a all wall/gran hooke 1 &\n yplane ${l} v_h\n"),
            "y=-1:4 ");
  EXPECT_EQ(
      walls("region box block 0 3 INF INF -1 INF units box\nfix a all wall/gran/region hooke 1 2 region box\n"),
      "x=0:3 z=-1: ");
  EXPECT_EQ(
      walls("fix a all wall/gran hooke 1 zplane 0 9\nunfix a\nfix a all wall/gran hooke 1 zplane 0 NULL\n"),
      "z=0: ");
}

/// In a region, the faces are numbered xlo, xhi, ylo, yhi, zlo, zhi, from 1.
TEST_F(WallFile, OfARegionHasNoPlaneAtAnOpenFace) {
  const std::vector<std::string> faces = {"x=0:", "x=:3 ", "y=1:", "y=:4 ", "z=2:", "z=:5 "};
  const std::string fix = "fix a all wall/gran/region hooke 1 2 region box\n";
  const std::array<std::string, 3> both = {"x=0:3 ", "y=1:4 ", "z=2:5 "};
  for (int face = 1; face <= 6; ++face) {
    std::array<std::string, 3> left = both;
    const auto axis = static_cast<std::size_t>((face - 1) / 2);
    left[axis] = face % 2 == 0 ? faces[2 * axis] + " " : faces[2 * axis + 1];
    EXPECT_EQ(walls(fmt::format("region box block 0 3 1 4 2 5 open {} units box\n{}", face, fix)),
              left[0] + left[1] + left[2])
        << face;
  }
  EXPECT_EQ(walls("region box block 0 3 1 4 2 5 side in open 1 open 2 open 6\n" + fix), "y=1:4 z=2: ");
  refused("region box block 0 3 1 4 2 5 open 7\n" + fix, "in.walls:1: the open face is \"7\"");
  for (const std::string motion : {"move v_x NULL NULL", "rotate v_t 0 0 0 0 0 1"})
    refused("region box block 0 3 1 4 2 5 units box " + motion + "\n" + fix, "in.walls:1: the wall moves");
}

/// In units "lj" the argument of `lattice` is the number of points per volume or area; in other units it is the lattice
/// constant.
TEST_F(WallFile, OfARegionHasLengthsInSpacingsOfTheLattice) {
  const std::string rest = "region box block 0 2 0 2 -1 2\nfix a all wall/gran/region hooke 1 2 region box\n";
  const auto high = [&](const std::string& before) {
    test::write_text(scratch_.file("in.walls"), before + "\n" + rest);
    std::vector<double> positions;
    for (const WallPlane& plane : read_wall_file(scratch_.file("in.walls")).planes)
      if (plane.side == 1) positions.push_back(plane.position);
    return positions;
  };
  const auto are = [](double x, double y, double z) {
    return testing::ElementsAre(testing::DoubleNear(x, 1e-14), testing::DoubleNear(y, 1e-14),
                                testing::DoubleNear(z, 1e-14));
  };
  const double root3 = std::sqrt(3.0), third = std::sqrt(8.0 / 3.0);
  EXPECT_THAT(high(""), are(2, 2, 2));
  EXPECT_THAT(high("lattice none 0.5"), are(1, 1, 1));
  for (const auto& [style, n] :
       {std::pair{"sc", 1.0}, {"bcc", 2.0}, {"fcc", 4.0}, {"diamond", 8.0}, {"sq", 1.0}, {"sq2", 2.0}}) {
    const double a = std::cbrt(n / 0.125);
    EXPECT_THAT(high(fmt::format("lattice {} 0.125", style)), are(2 * a, 2 * a, 2 * a)) << style;
    EXPECT_THAT(high(fmt::format("units si\nlattice {} 0.5", style)), are(1, 1, 1)) << style;
    const double b = std::sqrt(n / 0.25);
    EXPECT_THAT(high(fmt::format("dimension 2\nlattice {} 0.25", style)), are(2 * b, 2 * b, 2 * b)) << style;
  }
  EXPECT_THAT(high("units real\nlattice hex 0.5"), are(1, root3, 1));
  EXPECT_THAT(high("units real\nlattice hcp 0.5"), are(1, root3, third));
  const double of_hex = std::sqrt(2.0 / (root3 * 0.25));
  EXPECT_THAT(high("dimension 2\nlattice hex 0.25"), are(2 * of_hex, 2 * of_hex * root3, 2 * of_hex));
  EXPECT_EQ(walls("lattice sc 0.125\nregion box block 0 3 INF INF -1 INF units box\n"
                  "fix a all wall/gran/region hooke 1 2 region box\n"),
            "x=0:3 z=-1: ");
  refused("lattice custom 1 a1 1 0 0\n" + rest, "in.walls:1: the lengths of the region box are in spacings");
  refused("lattice sc 1 orient x 1 1 0\n" + rest, "in.walls:1: the lengths of the region box are in spacings");
}

TEST_F(WallFile, FollowsVariablesAndCommandsAsLammpsDoes) {
  const std::string wall = "fix w all wall/gran hooke 1 xplane 0 ${h}\n";
  EXPECT_EQ(walls("variable h index 1.994\nvariable h index 5\n" + wall), "x=0:1.994 ");
  EXPECT_EQ(walls("variable h index 1.994 3\n" + wall), "x=0:1.994 ");
  EXPECT_EQ(walls("variable h index 1.994\nvariable h delete\nvariable h index 5\n" + wall), "x=0:5 ");
  EXPECT_EQ(walls("variable h equal 1.994\nvariable h equal 5\n" + wall), "x=0:5 ");
  refused("variable h index 1 2\nnext h\n" + wall, "is \"${h}\", expected a number");
  EXPECT_EQ(walls("fix v all wall/gran hooke 1 zplane 0 9\nvariable h index 4\nclear\n" + wall), "x=0:4 ");
  refused("fix v all wall/gran hooke 1 zplane 0 9\nclear\n", "the script has no wall");
}

TEST_F(WallFile, SaysThatItDoesNotFollowConditionsWithWalls) {
  const auto doubts = [&](const std::string& text) {
    test::write_text(scratch_.file("in.walls"), text);
    return read_wall_file(scratch_.file("in.walls")).doubts;
  };
  const std::string wall = "fix w all wall/gran hooke 1 xplane 0 3\n";
  EXPECT_THAT(doubts(wall + "if \"${a} > 1\" then \"print yes\"\n"), testing::IsEmpty());
  for (const std::string then : {"fix v all wall/gran hooke 1 zplane 0 9", "unfix w"})
    EXPECT_THAT(doubts(wall + "if \"${a} > 1\" then \"" + then + "\"\n"),
                testing::ElementsAre(HasSubstr("in.walls:2: the command if is not followed")));
  refused("if \"${a} > 1\" then \"fix w all wall/gran hooke 1 xplane 0 3\"\n",
          "has no wall: expected a command \"fix ID group wall/gran ...\"; ");
}

TEST_F(WallFile, OfLiggghtsHasPlanesAndMeshes) {
  EXPECT_EQ(walls("fix a all wall/gran model hertz primitive type 1 xplane 0\nfix b all wall/gran model hertz "
                  "primitive type "
                  "1 xplane 3\n"),
            "x=0:3 ");
  write_triangle("0 0 -1;4 0 -1;4 4 -1");
  const std::string fix = "fix w all wall/gran model hertz mesh n_meshes 1 meshes m\n";
  EXPECT_EQ(walls("fix m all mesh/surface file s.stl type 1\n" + fix), "z=-1: ");
  EXPECT_EQ(walls("fix m all mesh/surface/stress file s.stl type 1 scale 2 move 0 0 6\n" + fix), "z=:4 ");
  EXPECT_EQ(in_words(ends_of_planes(read_wall_file(scratch_.file("s.stl")).planes, two_grains(), 3)), "z=-1: ");
  // If two faces are parallel, only the inner face counts as a wall, and only if it faces a grain.
  EXPECT_EQ(walls("fix a all wall/gran model hertz primitive type 1 zplane -0.5\nfix m all mesh/surface file "
                  "s.stl type 1\n" +
                  fix),
            "z=-0.5: ");
  write_triangle("5 0 -1;9 0 -1;9 4 -1");
  EXPECT_EQ(walls("fix m all mesh/surface file s.stl type 1\n" + fix), "");
}

TEST_F(WallFile, GivesGravity) {
  test::write_text(scratch_.file("in"),
                   "fix w all wall/gran hooke 1 zplane 0 NULL\nfix g all gravity 9.81 vector 0 0 -2\n");
  EXPECT_EQ(read_wall_file(scratch_.file("in")).gravity, Eigen::Vector3d(0.0, 0.0, -9.81));
}

TEST_F(WallFile, ThatFlocCannotTakeIsRefusedWithItsLine) {
  refused("units lj\n", "in.walls: the script has no wall");
  refused("\nfix w all wall/gran hooke 1 zcylinder 3\n", "in.walls:2: the wall is not a plane");
  refused("fix w all wall/gran hooke 1 zplane ${h} 3\n",
          "the position of the wall across z is \"${h}\", expected a number");
  refused("fix w all wall/gran hooke 1 zplane 0 NULL wiggle z 1 2\n", "the wall moves (wiggle)");
  refused("fix w all wall/gran/region hooke 1 region cone\n", "does not define the region");
  refused("region cone cone z 0 0 1 2 0 3\nfix w all wall/gran/region hooke 1 region cone\n",
          "the region cone is not a block");
  refused("fix w all wall/gran model hertz mesh n_meshes 1 meshes m\n", "no fix mesh/surface with the name m");
  refused(
      "fix m all mesh/surface file s.stl type 1\nfix v all move/mesh mesh m linear 0 0 1\nfix w all wall/gran "
      "model hertz "
      "mesh n_meshes 1 meshes m\n",
      "in.walls:2: the mesh m moves");
  refused("fix w all wall/gran hooke 1 zplane 0 NULL\nfix g all gravity 9.81 chute 24\n",
          "the style of gravity is \"chute\"");
  write_triangle("0 0 -1;4 0 -1;4 4 1");
  refused(
      "fix m all mesh/surface file s.stl type 1\nfix w all wall/gran model hertz mesh n_meshes 1 meshes m\n",
      "s.stl, triangle 1: the triangle is not perpendicular to an axis");
}

TEST(WallOption, HasAxesAndFiles) {
  const WallOption option = split_walls("in.lammps, z=0:,x-,xwall.stl,/dev/null");
  EXPECT_EQ(option.axes, " z=0:,x-");
  EXPECT_EQ(option.files, (std::vector<std::string>{"in.lammps", "xwall.stl", "/dev/null"}));
  EXPECT_EQ(split_walls("x=0.5:1.5").axes, "x=0.5:1.5");
  EXPECT_EQ(split_walls("x,,y").axes, "x,,y");
}

TEST_F(WallFile, HasTheSumOfSeveralGravities) {
  test::write_text(scratch_.file("in"),
                   "fix w all wall/gran hooke 1 zplane 0 NULL\nfix g all gravity 9 vector 0 0 -2\n"
                   "fix h all gravity 2 vector 3 0 0\n");
  EXPECT_EQ(read_wall_file(scratch_.file("in")).gravity, Eigen::Vector3d(2.0, 0.0, -9.0));
}

TEST_F(WallFile, SaysThatGroupsAreNotFollowed) {
  test::write_text(scratch_.file("in"),
                   "fix w all wall/gran hooke 1 zplane 0 NULL\nfix g heavy gravity 9 vector 0 0 -2\n"
                   "fix v light wall/gran hooke 1 xplane 0 NULL\nfix t light nve/sphere\n");
  EXPECT_THAT(read_wall_file(scratch_.file("in")).doubts,
              testing::UnorderedElementsAre(
                  HasSubstr("in:2: the fix g of style gravity acts on the group heavy, expected all"),
                  HasSubstr("in:3: the fix v of style wall/gran acts on the group light, expected all")));
}

}  // namespace
}  // namespace floc
