#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/read_text.h"
#include "floc/io/law_text.h"
#include "floc/io/rockable.h"
#include "floc/io/rockable_text.h"
#include "support/angular_packing.h"
#include "support/few_grains.h"

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

/// Interaction in a configuration: bodies, type, features, gap and contact point.
struct Interaction {
  int i, j, type, isub, jsub;
  double gap;
  Vec<3> point;
};

std::vector<Interaction> interactions_of(const std::string& path) {
  std::istringstream in(read_text(path));
  std::string line, word;
  int n = 0;
  while (word != "Interactions" && std::getline(in, line)) {
    std::istringstream words(line);
    words >> word >> n;
  }
  std::vector<Interaction> out(n);
  for (Interaction& c : out) {
    std::getline(in, line);
    std::istringstream words(line);
    Vec<3> normal;
    words >> c.i >> c.j >> c.type >> c.isub >> c.jsub >> normal[0] >> normal[1] >> normal[2] >> c.gap >>
        c.point[0] >> c.point[1] >> c.point[2];
  }
  return out;
}

/// Features of a grain in space, numbered as in the file of shapes.
struct Features {
  PlacedShape<3> body;
  Vec<3> vertex(int v) const {
    return body.position + body.scale * (body.rotation * core_vertex<3>(*body.shape, v));
  }
  std::pair<Vec<3>, Vec<3>> edge(int e) const {
    if (body.shape->n_edges() == 0) return {vertex(0), vertex(1)};  // a capsule
    return {vertex(body.shape->edges[e].from), vertex(body.shape->edges[e].to)};
  }
};

/// Returns the core points of two bodies that meet in an interaction, as Rockable computes them from the features.
std::pair<Vec<3>, Vec<3>> core_points(const Interaction& c, const Features& i, const Features& j) {
  if (c.type == 0) return {i.vertex(c.isub), j.vertex(c.jsub)};
  if (c.type == 1) {
    const auto [from, to] = j.edge(c.jsub);
    const Vec<3> x = i.vertex(c.isub), along = to - from;
    return {x, Vec<3>(from + along * (x - from).dot(along) / along.squaredNorm())};
  }
  if (c.type == 2) {
    const Vec<3> n = j.body.rotation * j.body.shape->normals[c.jsub], x = i.vertex(c.isub);
    return {x, Vec<3>(x - (n.dot(x - j.body.position) - j.body.scale * j.body.shape->offsets[c.jsub]) * n)};
  }
  const auto [p, p_end] = i.edge(c.isub);
  const auto [q, q_end] = j.edge(c.jsub);
  const Vec<3> u = p_end - p, v = q_end - q;
  const Eigen::Vector2d at =
      (Eigen::Matrix2d() << u.dot(u), -u.dot(v), u.dot(v), -v.dot(v)).finished().inverse() *
      Eigen::Vector2d(u.dot(q - p), v.dot(q - p));
  return {Vec<3>(p + at[0] * u), Vec<3>(q + at[1] * v)};
}

/// Rockable computes contact points anew from the numbers of the features, and keeps one interaction of each set of
/// numbers.
TEST(RockableShapes, InteractionsNameTheFeaturesThatMeet) {
  for (const test::Ends<3>& ends : {test::Ends<3>{"p", "p", "p"}, test::Ends<3>{"ww", "ww", "ww"}}) {
    // Large radii of rounding, so that the cores do not overlap: Rockable has no contacts of such grains.
    std::vector<Shape<3>> shapes = cut_shapes<3>({}, 3, 0.4, 7);
    shapes.push_back(round_shape<3>(0.5));
    shapes.push_back(capsule_shape<3>(0.6, 0.4));
    const State<3> state = test::angular_packing_with_forces<3>(ends, shapes);
    const Packing<3>& p = state.packing;
    const test::ScratchDirectory scratch;
    write_rockable(scratch.file("p.conf"), state);
    const int n_plates = static_cast<int>(p.walls.size());
    std::set<std::tuple<int, int, int, int, int>> numbers;
    std::set<int> types;
    int n_compared = 0;
    for (const Interaction& c : interactions_of(scratch.file("p.conf"))) {
      EXPECT_TRUE(numbers.emplace(c.i, c.j, c.type, c.isub, c.jsub).second);
      if (c.j < n_plates) {
        const Features grain{p.grains.placed(c.i - n_plates)};
        const Wall<3>& wall = p.walls[c.j];
        EXPECT_EQ(c.type, 2);
        EXPECT_NEAR(wall.side * (wall.position - grain.vertex(c.isub)[wall.axis]),
                    c.gap + grain.body.rounding(), 1e-12);
        continue;
      }
      const Features i{p.grains.placed(c.i - n_plates)};
      Features j{p.grains.placed(c.j - n_plates)};
      Vec<3> cells = p.cell.reduced(j.body.position - i.body.position);
      for (int a = 0; a < 3; ++a) cells[a] = p.walls.empty() ? std::round(cells[a]) : 0.0;
      j.body.position -= p.cell.matrix.transpose() * cells;
      const auto [on_i, on_j] = core_points(c, i, j);
      const Vec<3> n = (on_i - on_j).normalized();
      EXPECT_NEAR((on_i - on_j).norm() - i.body.rounding() - j.body.rounding(), c.gap, 1e-6);
      EXPECT_NEAR((on_i - n * (i.body.rounding() + 0.5 * c.gap) - c.point).norm(), 0.0, 1e-6);
      types.insert(c.type);
      ++n_compared;
    }
    EXPECT_GT(n_compared, 20);
    EXPECT_GE(types.size(), 2u);
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
  State<3> small = test::packing_with_forces<3>({"p", "p", "p"});
  small.packing.contacts[0].image[0] += 1;
  refusal(small, "that is not the nearest one");
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
  write_cubes(scratch, good + good);
  std::string text = read_text(scratch.file("cubes.conf"));
  text.replace(text.find("Interactions 2"), 14, "Interactions 1");
  test::write_text(scratch.file("cubes.conf"), text);
  EXPECT_THAT(
      [&] { test::read_packing<3>(scratch.file("cubes.conf")); },
      ThrowsMessage<InputError>(HasSubstr("Interactions has more than the 1 rows that its head states")));
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
  EXPECT_EQ(p.contacts[0].type, ContactType::kVertexFace);
  const auto kind = [&](const std::string& name) {
    return read("id1,id2,point1,point2,point3,kind,force1,force2,force3\n1,0,0.4,0.4,0.5," + name +
                ",0.5,0,2\n")
        .contacts[0]
        .type;
  };
  for (const ContactType type :
       {ContactType::kVertexFace, ContactType::kEdgeEdge, ContactType::kDouble, ContactType::kFaceFace})
    EXPECT_EQ(kind(contact_type_name(type)), type);
  EXPECT_EQ(kind(""), ContactType::kVertexFace);
  const auto refusal = [&](const std::string& text, const std::string& words) {
    EXPECT_THAT([&] { read(text); }, ThrowsMessage<InputError>(HasSubstr(words)));
  };
  EXPECT_THAT([&] { kind("corner"); },
              ThrowsMessage<InputError>(HasSubstr("kind = corner, expected vertex-face")));
  refusal("id1,id2,normal_force\n0,1,2\n", "contacts.csv:2: the contact has no contact point");
  refusal("id1,id2,point1,point2,point3\n0,1,0.4,0.4,0.5\n", "the contact has no force");
  refusal("id1,id2,point1,point2,normal_force\n0,1,0.4,0.4,0.5\n", "point3");
}

/// Reads the cubes with one interaction, of which some words are replaced.
Imported read_cubes(const test::ScratchDirectory& scratch, const std::string& from = "",
                    const std::string& to = "", const std::string& file = "cubes.conf") {
  const std::string good = fmt::format(fmt::runtime(kCornerOnFace), 2, 0.4, 0.4, 1);
  write_cubes(scratch, good);
  if (!from.empty()) test::change_file(scratch.file(file), from, to);
  ImportOptions options;
  options.law = parse_law("law", test::kForeignLaw);
  options.walls = "x=:,y=:,z=:";
  return read_rockable(scratch.file("cubes.conf"), options);
}

/// The corner of the upper cube lies 0.1 above the point, or the gap is -0.3; the diameter of the smaller cube is 1.59.
TEST(RockableShapes, SayWhichPointsDoNotFitTheShapes) {
  const test::ScratchDirectory scratch;
  const std::string words = "1 of 1 contact points do not fit the shapes (first at ";
  EXPECT_THAT(read_cubes(scratch).inconsistencies, testing::Not(testing::Contains(HasSubstr(words))));
  EXPECT_THAT(read_cubes(scratch, "0.4 0.4 0.5", "0.4 0.4 0.6").inconsistencies,
              testing::Contains(testing::AllOf(HasSubstr(words), HasSubstr("cubes.conf:9, grains 0 and 1"),
                                               HasSubstr("0.063 diameters of the smaller grain"))));
  EXPECT_THAT(read_cubes(scratch, "-1 -0.01", "-1 -0.3").inconsistencies,
              testing::Contains(HasSubstr("0.19 diameters of the smaller grain")));
  EXPECT_THAT(read_cubes(scratch, "0 0 1.5", "0 0.1 1.6").inconsistencies,
              testing::Contains(HasSubstr("0.069 diameters of the smaller grain")));
}

TEST(RockableShapes, HaveNormalsOfLengthOneInTheRightDirection) {
  const test::ScratchDirectory scratch;
  const auto refusal = [&](const std::string& from, const std::string& to, const std::string& words) {
    EXPECT_THAT([&] { read_cubes(scratch, from, to); }, ThrowsMessage<InputError>(HasSubstr(words))) << to;
  };
  refusal("0 0 -1 -0.01", "0 0 -1.01 -0.01", "cubes.conf:9: the normal of the contact has the length 1.01");
  refusal("0 0 -1 -0.01", "0 0 1 -0.01",
          "cubes.conf:9: the normal of the contact of grains 0 and 1 is reversed");
  // Digits that are cut change the length of a normal, but neither its direction nor the force.
  const Imported read = read_cubes(scratch, "0 0 -1 -0.01", "0 0 -0.9995 -0.01");
  const Contact<3> c = std::get<State<3>>(read.state).packing.contacts.at(0);
  EXPECT_EQ(c.normal, Vec<3>(0.0, 0.0, 1.0));
  EXPECT_EQ(c.normal_force, 1.0);
}

TEST(RockableShapes, NameContradictionsOfAConfiguration) {
  const test::ScratchDirectory scratch;
  const auto refusal = [&](const std::string& from, const std::string& to, const std::string& words,
                           const std::string& file = "cubes.conf") {
    EXPECT_THAT([&] { read_cubes(scratch, from, to, file); }, ThrowsMessage<InputError>(HasSubstr(words)))
        << to;
  };
  refusal("0 1 2 0 0", "1 1 2 0 0", "cubes.conf:9: the first and the second body of the contact are grain 1");
  refusal("0 1 2 0 0", "0 1 4 0 0", "cubes.conf:9: the type of the interaction is 4, expected 0");
  refusal("0 0 0 0 1 0 0 0", "0 0 0 0 0 0 0 0", "cubes.conf:6: the orientation is the quaternion 0 0 0 0");
  refusal("nDriven", "usePeriodicCell 1\nnDriven", "cubes.conf:4: usePeriodicCell is 1, but the configuration");
  refusal(">\n", ">\n<\nname Cube\nradius 0.1\nnv 1\n0 0 0\n>\n", "a shape above has the name Cube, too",
          "cubes.shp");
  EXPECT_THAT(read_cubes(scratch).remarks, testing::Not(testing::Contains(HasSubstr("there is no mass"))));
  EXPECT_THAT(read_cubes(scratch, "density 0 3\n", "").remarks,
              testing::Contains(HasSubstr("there is no mass for 2 of 2 grains")));
}

/// The volume of the cube is that of a cube of side 0.8, of six plates, twelve quarter cylinders and a sphere.
TEST(RockableShapes, SayWhichDataOfAShapeContradictTheConvexShape) {
  const test::ScratchDirectory scratch;
  const auto changed = [&](const std::string& from, const std::string& to) {
    return read_cubes(scratch, from, to, "cubes.shp");
  };
  EXPECT_THAT(changed("volume 0.9", "volume 0.97").remarks, testing::IsEmpty());
  EXPECT_THAT(changed("volume 0.9", "volume 0.97").inconsistencies,
              testing::Not(testing::Contains(HasSubstr("in the file, but the convex shape has"))));
  EXPECT_THAT(
      changed("volume 0.9", "volume 0.95").remarks,
      testing::Contains(HasSubstr("the volume is 0.95 in the file, but the convex shape has 0.975587")));
  EXPECT_THAT(changed("volume 0.9", "volume 9").inconsistencies,
              testing::Contains(HasSubstr("the volume is 9 in the file")));
  EXPECT_THAT(changed("volume 0.9", "I/m 0.15 0.3 0.15\nvolume 0.97").inconsistencies,
              testing::Contains(HasSubstr("(I/m) are 0.15, 0.15 and 0.3 in the file")));
  EXPECT_THAT(changed("-0.4 -0.4 -0.4\n", "-0.3 -0.4 -0.4\n").inconsistencies,
              testing::Contains(HasSubstr("the centre of mass of the convex shape is 0.0")));
}

TEST(RockableShapes, NeedTheNameOfASecondFile) {
  const test::ScratchDirectory scratch;
  const State<3> state = test::packing_with_forces<3>({"p", "p", "p"});
  const auto refusal = [&](const std::string& path, const std::string& words) {
    EXPECT_THAT([&] { write_rockable(path, state); }, ThrowsMessage<InputError>(HasSubstr(words)));
    EXPECT_FALSE(std::filesystem::exists(path));
  };
  refusal("-", "standard output is one file");
  refusal(scratch.file("p.shp"),
          "the file of shapes, which belongs to the configuration, would have the same name");
  refusal(scratch.file("two words.conf"), "this name has a blank or #");
  EXPECT_FALSE(std::filesystem::exists("-.shp"));
}

/// Two cubes of side 1 side by side along z in a cell that is 1.5 long along x and y: half of its width is less than
/// the distance of the centres, but no image touches at the same points.
TEST(RockableShapes, ComeBackFromCellsThatAreSmall) {
  State<3> state;
  Packing<3>& p = state.packing;
  p = test::unit_grains<3>({{0.2, 0.2, 0.5}, {0.2, 0.2, 1.4999}}, 1.5, parse_law("law", test::kForeignLaw));
  p.cell.matrix(2, 2) = 4.0;
  Grains<3>& g = p.grains;
  g.shapes = std::make_shared<const std::vector<Shape<3>>>(1, box<3>(Vec<3>(1.0, 1.0, 1.0), 0.1));
  const Shape<3>& cube = g.shapes->front();
  g.shape = {0, 0};
  g.scale.assign(2, 0.5 / (cube.offsets[0] + cube.rounding));
  g.radius.assign(2, g.scale[0] * cube.outer_radius);
  p.contacts = ContactPoints<3>().find(p, 0.0);
  ASSERT_EQ(p.contacts.size(), 4u);
  for (Contact<3>& c : p.contacts) c.normal_force = c.elastic_force = 1.0;
  measure(state);
  const test::ScratchDirectory scratch;
  write_rockable(scratch.file("p.conf"), state);
  test::expect_same_angular_packing(test::read_packing<3>(scratch.file("p.conf")), p, 1e-12);
  // If the point lies at no image, it does not tell which of them touches.
  const std::string path = scratch.file("p.conf");
  test::change_file(path, "Interactions 4\n0 1 ", "Interactions 4\n0 0 ");
  EXPECT_THAT([&] { test::read_packing<3>(path); }, ThrowsMessage<InputError>(HasSubstr("would touch itself")));
}

}  // namespace
}  // namespace floc
