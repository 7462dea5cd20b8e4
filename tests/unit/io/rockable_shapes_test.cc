#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "floc/base/error.h"
#include "floc/io/rockable.h"
#include "floc/io/rockable_text.h"
#include "support/angular_packing.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(RockableShapes, GoOutAndComeBackAsTheyWere) {
  for (const test::Ends<3>& ends :
       {test::Ends<3>{"p", "p", "p"}, test::Ends<3>{"ww", "ww", "ww"}, test::Ends<3>{"ww", "oo", "wo"}}) {
    SCOPED_TRACE(testing::PrintToString(ends));
    State<3> written = test::angular_packing_with_forces<3>(ends);
    if (ends[0] != "p") written.packing.gravity = Vec<3>(0.0, 0.0, -9.81);
    ASSERT_GT(written.packing.contacts.size(), 10u);
    const test::ScratchDirectory scratch;
    write_rockable(scratch.file("p.conf"), written);
    EXPECT_TRUE(is_rockable(scratch.file("p.conf")));
    const Packing<3> read = test::read_packing<3>(scratch.file("p.conf"));
    test::expect_same_angular_packing(read, written.packing, 1e-12);
    EXPECT_EQ(read.gravity, written.packing.gravity);
    EXPECT_NEAR((read.cell.matrix - written.packing.cell.matrix).norm(), 0.0, 1e-12);
  }
}

TEST(RockableShapes, SpheresGoOutAndComeBackAsTheyWere) {
  for (const test::Ends<3>& ends : {test::Ends<3>{"p", "p", "p"}, test::Ends<3>{"ww", "ww", "ww"}}) {
    const State<3> written = test::packing_with_forces<3>(ends);
    const test::ScratchDirectory scratch;
    write_rockable(scratch.file("p.conf"), written);
    test::expect_same_packing(test::read_packing<3>(scratch.file("p.conf")), written.packing, 1e-12);
  }
}

TEST(RockableShapes, SaysWhatItCannotHold) {
  const test::ScratchDirectory scratch;
  const auto refusal = [&](const AnyState& state, const std::string& words) {
    EXPECT_THAT([&] { write_rockable(scratch.file("p.conf"), state); },
                ThrowsMessage<InputError>(HasSubstr(words)));
    EXPECT_FALSE(std::filesystem::exists(scratch.file("p.conf")));
    EXPECT_FALSE(std::filesystem::exists(scratch.file("p.shp")));
  };
  refusal(test::packing_with_forces<2>({"p", "p"}), "two-dimensional");
  refusal(test::packing_with_forces<3>({"p", "ww", "ww"}), "periodic along x and not along other axes");
  refusal(test::angular_packing_with_forces<3>({"p", "p", "p"}, {box<3>(Vec<3>(1.0, 1.0, 1.2), 0.0)}),
          "shape 0 has sharp corners");
  State<3> bonded = test::packing_with_forces<3>({"p", "p", "p"});
  bonded.packing.contacts[0].bonded = true;
  refusal(bonded, "contacts that act across gaps");
}

/// Writes two cubes of side 1, one on top of the other, with edges rounded by 0.1. Each line of `interactions` is one
/// interaction.
void write_cubes(const test::ScratchDirectory& scratch, const std::string& interactions,
                 const std::string& more = "preCompDone y\n") {
  const auto n = std::count(interactions.begin(), interactions.end(), '\n');
  test::write_text(
      scratch.file("cubes.conf"),
      "Rockable 29-11-2018\nshapeFile cubes.shp\ndensity 0 3\nnDriven 0\nParticles 2\n"
      "Cube 0 0 1 0 0 0 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\nCube 0 0 2 0 0 1.5 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\n" +
          fmt::format("Interactions {}\n", n) + interactions);
  test::write_text(scratch.file("cubes.shp"), "<\nname Cube\nradius 0.1\n" + more +
                                                  "volume 0.9\nnv 8\n-0.4 -0.4 -0.4\n0.4 -0.4 -0.4\n0.4 0.4 "
                                                  "-0.4\n-0.4 0.4 -0.4\n-0.4 -0.4 0.4\n0.4 -0.4 "
                                                  "0.4\n0.4 0.4 0.4\n-0.4 0.4 0.4\nne 0\nnf 6\n4 0 1 2 3\n4 4 "
                                                  "5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 "
                                                  "4 7\n>\n");
}

const std::string kCornerOnFace = "0 1 {} 0 0 0 0 -1 -0.01 {} {} 0.5 0 0 0 {} 0.5 0 0 0 0 0 0\n";

TEST(RockableShapes, ReadsHomothetyNormalsAndTypes) {
  const test::ScratchDirectory scratch;
  const auto point = [](int type, double x, double y, double fn) {
    return fmt::format(fmt::runtime(kCornerOnFace), type, x, y, fn);
  };
  const auto read = [&](const std::string& interactions) {
    write_cubes(scratch, interactions);
    ImportOptions options;
    options.walls = "x=:,y=:,z=:";
    return test::read_packing<3>(scratch.file("cubes.conf"), options);
  };
  const Packing<3> four =
      read(point(2, 0.4, 0.4, 1) + point(2, -0.4, 0.4, 2) + point(2, 0.4, -0.4, 3) + point(3, -0.4, -0.4, 4));
  ASSERT_EQ(four.contacts.size(), 4u);
  EXPECT_DOUBLE_EQ(four.grains.scale[1], 2.0);
  EXPECT_NEAR(four.grains.mass[1], 3.0 * 0.9 * 8.0, 1e-14);
  EXPECT_NEAR(four.grains.placed(1).rounding(), 0.2, 1e-15);
  double sum = 0.0;
  for (const Contact<3>& c : four.contacts) {
    EXPECT_EQ(c.type, ContactType::kFaceFace);
    EXPECT_EQ(c.normal, Vec<3>(0.0, 0.0, 1.0));  // in the file the normal points from j to i
    EXPECT_EQ(c.shear_force, Vec<3>(0.5, 0.0, 0.0));
    EXPECT_DOUBLE_EQ(c.gap, -0.01);
    sum += c.normal_force;
  }
  EXPECT_DOUBLE_EQ(sum, 10.0);
  EXPECT_EQ(read(point(3, 0.4, 0.4, 1)).contacts[0].type, ContactType::kEdgeEdge);
  EXPECT_EQ(read(point(2, 0.4, 0.4, 1)).contacts[0].type, ContactType::kVertexFace);
  EXPECT_EQ(read(point(2, 0.4, 0.4, 1) + point(3, 0.0, 0.4, 1)).contacts[0].type, ContactType::kDouble);
  // The file may list more contact points for a pair than floc finds from the shapes. Each listed point must
  // nevertheless get a key of its own.
  std::string many;
  for (int k = 0; k < 12; ++k) many += point(2, 0.4 - 0.05 * k, 0.4, 1);
  const Packing<3> twelve = read(many);
  std::set<int> keys;
  for (const Contact<3>& c : twelve.contacts) keys.insert(c.key);
  EXPECT_EQ(keys.size(), 12u);
}

TEST(RockableShapes, NamesWhatIsWrong) {
  const test::ScratchDirectory scratch;
  const auto refusal = [&](const std::string& interactions, const std::string& words,
                           const std::string& more = "preCompDone y\n") {
    write_cubes(scratch, interactions, more);
    ImportOptions options;
    options.walls = "x=:,y=:,z=:";
    EXPECT_THAT([&] { test::read_packing<3>(scratch.file("cubes.conf"), options); },
                ThrowsMessage<InputError>(HasSubstr(words)));
  };
  const std::string good = fmt::format(fmt::runtime(kCornerOnFace), 2, 0.4, 0.4, 1);
  refusal(good + good, "cubes.conf:10: the contact of grains 0 and 1 is listed twice");
  refusal(fmt::format(fmt::runtime(kCornerOnFace), 2, 4, 0.4, 1), "cubes.conf:9: the contact point is 4.0");
  refusal(fmt::format(fmt::runtime(kCornerOnFace), 2, 0.4, 0.4, -1), "carries a tensile force of");
  refusal("0 1 2 0 0 0 0 -3 -0.01 0.4 0.4 0.5 0 0 0 1 0 0 0\n", "the normal of the contact has the length 3");
  refusal("0 1 2 0 0 0 0 -1 -0.01 0.4\n", "cubes.conf:9");
  refusal(good, "preCompDone", "preCompDone n\n");
  refusal(good, "preCompDone", "");
}

TEST(RockableShapes, TakeContactPointsOfAnotherList) {
  const test::ScratchDirectory scratch;
  write_cubes(scratch, "");
  ImportOptions options;
  options.walls = "x=:,y=:,z=:";
  options.contacts = scratch.file("contacts.csv");
  const auto read = [&](const std::string& text) {
    test::write_text(scratch.file("contacts.csv"), text);
    return test::read_packing<3>(scratch.file("cubes.conf"), options);
  };
  const Packing<3> p = read("id1,id2,point1,point2,point3,force1,force2,force3\n1,0,0.4,0.4,0.5,0.5,0,2\n");
  ASSERT_EQ(p.contacts.size(), 1u);
  EXPECT_NEAR(p.contacts[0].normal_force, 2.0, 1e-14);
  EXPECT_NEAR((p.contacts[0].arm_i - Vec<3>(0.4, 0.4, 0.5)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((p.contacts[0].arm_j - Vec<3>(0.4, 0.4, -1.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((p.contacts[0].shear_force - Vec<3>(-0.5, 0.0, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(p.contacts[0].gap, 0.0, 1e-14);  // gap computed from the shapes
  const auto refusal = [&](const std::string& text, const std::string& words) {
    EXPECT_THAT([&] { read(text); }, ThrowsMessage<InputError>(HasSubstr(words)));
  };
  refusal("id1,id2,normal_force\n0,1,2\n", "contacts.csv:2: the contact has no contact point");
  refusal("id1,id2,point1,point2,point3\n0,1,0.4,0.4,0.5\n", "the contact has no force");
  refusal("id1,id2,point1,point2,normal_force\n0,1,0.4,0.4,0.5\n", "point3");
}

}  // namespace
}  // namespace floc
