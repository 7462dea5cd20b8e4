#include "floc/shape/read_shapes.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "floc/base/error.h"
#include "support/message_of.h"
#include "support/scratch_directory.h"
#include "unit/shape/solids.h"

namespace floc {
namespace {

using testing::HasSubstr;

/// Returns the text of a polytope in the OFF format. The functions below return other formats.
std::string off_text(const Polytope<3>& p) {
  std::string text = fmt::format("OFF\n# a comment\n{} {} 0\n", p.vertices.size(), p.faces.size());
  for (const Vec<3>& v : p.vertices) text += fmt::format("{} {} {}\n", v[0], v[1], v[2]);
  for (const std::vector<int>& face : p.faces) {
    text += fmt::format("{}", face.size());
    for (const int i : face) text += fmt::format(" {}", i);
    text += "\n";
  }
  return text;
}

std::string obj_text(const Polytope<3>& p) {
  std::string text = "o stone\nmtllib none.mtl\n";
  for (const Vec<3>& v : p.vertices) text += fmt::format("v {} {} {}\nvn 0 0 1\n", v[0], v[1], v[2]);
  for (std::size_t f = 0; f < p.faces.size(); ++f) {
    text += "f";
    for (const int i : p.faces[f])
      text += f % 2 ? fmt::format(" {}//{}", i + 1, i + 1)
                    : fmt::format(" {}", i - static_cast<int>(p.vertices.size()));
    text += "\n";
  }
  return text;
}

std::string shp_text(const Polytope<3>& p) {
  std::string text = fmt::format("<\nname Stone\nradius 0.05\npreCompDone y\nnv {}\n", p.vertices.size());
  for (const Vec<3>& v : p.vertices) text += fmt::format("{} {} {}\n", v[0], v[1], v[2]);
  text += fmt::format("ne 1\n0 1\nnf {}\n", p.faces.size());
  for (std::vector<int> face : p.faces) {
    if (face[0] % 2 == 1) std::reverse(face.begin(), face.end());
    text += fmt::format("{} {}\n", face.size(), fmt::join(face, " "));
  }
  return text +
         "obb.extent 1 1 1\nvolume 1\nI/m 1 1 1\n>\n\n<\nname Ball\nradius 0.2\nnv 1\n0 0 0\nne 0\nnf 0\n";
}

std::string csv_text(const Polytope<3>& p) {
  std::string text = "x,y,z\n";
  for (const Vec<3>& v : p.vertices) text += fmt::format("{},{},{}\n", v[0], v[1], v[2]);
  return text;
}

std::string stl_text(const Polytope<3>& p) {
  std::string text = "solid stone\n";
  for (const std::vector<int>& face : p.faces)
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int i : {face[0], face[k], face[k + 1]})
        text += fmt::format("vertex {} {} {}\n", p.vertices[i][0], p.vertices[i][1], p.vertices[i][2]);
      text += "endloop\nendfacet\n";
    }
  return text + "endsolid stone\n";
}

std::string stl_bytes(const Polytope<3>& p) {
  std::string body;
  std::uint32_t n = 0;
  for (const std::vector<int>& face : p.faces)
    for (std::size_t k = 1; k + 1 < face.size(); ++k, ++n) {
      float numbers[12] = {};
      for (int c = 0; c < 3; ++c)
        for (int a = 0; a < 3; ++a)
          numbers[3 + 3 * c + a] = static_cast<float>(p.vertices[face[c == 0 ? 0 : k + c - 1]][a]);
      body.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
      body.append(2, '\0');
    }
  std::string header = "solid is what some binary files begin with";
  header.resize(80, ' ');
  header.append(reinterpret_cast<const char*>(&n), 4);
  return header + body;
}

Polytope<3> stone() {
  RandomStream random(9, 1);
  return convex_hull<3>(test::random_points<3>(random, 14)).polytope;
}

std::string message_of_text(const std::string& path, const std::string& text,
                            const ShapeFileOptions& options = {}) {
  return test::message_of([&] {
    path.ends_with("2.csv") ? (void)parse_shapes<2>(path, text, options)
                            : (void)parse_shapes<3>(path, text, options);
  });
}

TEST(ShapeFiles, OfAllFormatsGiveTheShapeBack) {
  const Polytope<3> given = stone();
  const Shape<3> sharp = polytope_shape<3>(given, 0.0);
  const auto expect = [&](const std::string& path, const std::string& content, double tolerance) {
    SCOPED_TRACE(path);
    const auto shapes = parse_shapes<3>(path, content);
    ASSERT_EQ(shapes.size(), 1u);
    EXPECT_TRUE(shapes[0].remarks.empty());
    EXPECT_EQ(shapes[0].shape.n_faces(), sharp.n_faces());
    EXPECT_NEAR(shapes[0].shape.volume, sharp.volume, tolerance);
    EXPECT_NEAR((shapes[0].shape.centre - sharp.centre).norm(), 0.0, tolerance);
  };
  expect("stone.off", off_text(given), 1e-15);
  expect("stone.OBJ", obj_text(given), 1e-15);
  expect("stone.csv", csv_text(given), 1e-15);
  expect("ascii.stl", stl_text(given), 1e-15);
  expect("binary.stl", stl_bytes(given), 1e-6);  // single precision
  const auto rockable = parse_shapes<3>("stones.shp", shp_text(given));
  ASSERT_EQ(rockable.size(), 2u);
  EXPECT_EQ(rockable[0].name, "Stone");
  EXPECT_EQ(rockable[0].shape.rounding, 0.05);
  EXPECT_NEAR(rockable[0].shape.volume, polytope_shape<3>(given, 0.05).volume, 1e-15);
  EXPECT_TRUE(rockable[1].shape.is_round());
  EXPECT_EQ(rockable[1].shape.outer_radius, 0.2);
  EXPECT_NEAR(parse_shapes<2>("triangle.csv", "\"x\";\"y\"\n0;0\n3;0\n0;4\n")[0].shape.volume, 6.0, 1e-15);
}

TEST(ShapeFiles, MayHaveTheirCornersRounded) {
  const Polytope<3> given = stone();
  const Shape<3> shape = parse_shapes<3>("stone.off", off_text(given), {.rounding = 0.1})[0].shape;
  EXPECT_NEAR(shape.rounding, 0.1 * shape.diameter(), 1e-14);
  EXPECT_THAT(message_of_text("stone.shp", shp_text(given), {.rounding = 0.1}),
              HasSubstr("the file already gives a radius of rounding"));
}

TEST(ShapeFiles, AreReadFromDisk) {
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("stone.stl");
  const std::string bytes = stl_bytes(stone());
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  EXPECT_EQ(read_shapes<3>(path).size(), 1u);
  std::remove(path.c_str());
  EXPECT_THROW(read_shapes<3>(path), InputError);
}

TEST(ShapeFiles, NotConvexAreTheirHullWithARemark) {
  // A cube with the centre of its top pressed in.
  Polytope<3> dented = convex_hull<3>(test::box_points(1, 1, 1)).polytope;
  dented.vertices.emplace_back(0, 0, 0.2);
  std::vector<std::vector<int>> faces;
  for (const std::vector<int>& face : dented.faces) {
    bool is_top = true;
    for (const int i : face) is_top = is_top && dented.vertices[i][2] > 0.0;
    if (!is_top) faces.push_back(face);
    for (std::size_t k = 0; is_top && k < face.size(); ++k)
      faces.push_back({face[k], face[(k + 1) % face.size()], 8});
  }
  dented.faces = faces;
  const auto shapes = parse_shapes<3>("dent.off", off_text(dented));
  EXPECT_NEAR(shapes[0].shape.volume, 1.0, 1e-15);
  ASSERT_EQ(shapes[0].remarks.size(), 2u);
  EXPECT_THAT(shapes[0].remarks[0], HasSubstr("1 of 9 points are not vertices"));
  EXPECT_THAT(shapes[0].remarks[1], HasSubstr("encloses 0.9 of the volume of its convex hull"));
}

TEST(ShapeFiles, OfManyVerticesAreTakenWithFewer) {
  RandomStream random(1, 1);
  std::vector<Vec<3>> points;
  for (int k = 0; k < 1000; ++k) points.push_back(test::random_direction<3>(random));
  const std::string text = off_text(convex_hull<3>(points).polytope);
  EXPECT_THAT(message_of_text("scan.off", text),
              HasSubstr("the convex hull has 1000 vertices: expected at most 200"));
  const auto few = parse_shapes<3>("scan.off", text, {.vertices = 100})[0];
  EXPECT_EQ(few.shape.n_vertices(), 100);
  EXPECT_GT(few.shape.volume, 0.85 * 4.18);
  EXPECT_THAT(few.remarks[0], HasSubstr("100 of 1000 vertices of the convex hull are kept"));
  EXPECT_THAT(message_of_text("scan.off", text, {.vertices = 3}),
              HasSubstr("vertices = 3: expected a whole number from 4"));
}

TEST(ShapeFiles, AreRefusedWithFileAndLine) {
  const std::string tetrahedron =
      "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  EXPECT_EQ(message_of_text("t.off", tetrahedron), "");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = tetrahedron;
    return message_of_text("t.off", text.replace(text.find(from), from.size(), to));
  };
  EXPECT_EQ(changed("OFF", "COFF"), "t.off:1: the file begins with \"COFF\": expected OFF");
  EXPECT_EQ(changed("4 4 6", "4000000000 4 6"),
            "t.off:2: \"4000000000\": expected a whole number from 1 to 20000");
  EXPECT_EQ(changed("4 4 6", "4"),
            "t.off:2: the line has only 1 words: expected a whole number from 0 to 80000 as word 2");
  EXPECT_EQ(changed("1 0 0", "1 0"), "t.off:4: the line has only 2 words: expected a finite number as word 3");
  EXPECT_EQ(changed("1 0 0", "nan 0 0"), "t.off:4: \"nan\": expected a finite number");
  EXPECT_EQ(changed("1 0 0", "0,5 0 0"),
            "t.off:4: \"0,5\": expected a finite number with a decimal point, not a comma");
  EXPECT_EQ(changed("3 1 2 3", "3 1 2 4"), "t.off:10: \"4\": expected a whole number from 0 to 3");
  EXPECT_EQ(changed("3 1 2 3\n", ""), "t.off: the file ends too early: expected face 4 of 4");
  EXPECT_EQ(changed("3 1 2 3\n", "3 1 2 3\n3 1 2 3\n"),
            "t.off:11: found a line after the last of 4 faces: expected the end of the file");
  EXPECT_THAT(changed("3 1 2 3", "3 1 3 2"), HasSubstr("two faces have vertex 2 before vertex 4"));
  EXPECT_THAT(changed("3 1 2 3", "3 0 2 1"), HasSubstr("expected a closed surface"));
  EXPECT_THAT(changed("0 0 1\n", "0 1 0\n"), HasSubstr("in one plane"));
  EXPECT_THAT(message_of_text("t.ply", ""),
              HasSubstr("expected a name that ends in .off, .obj, .stl, .csv or .shp"));
  EXPECT_THAT(message_of_text("t.obj", "v 0 0 0\nf 1 2 3\n"),
              HasSubstr("t.obj:2: \"2\": expected the number of a vertex in a line above"));
  EXPECT_THAT(message_of_text("t.obj", "w 0 0 0\n"),
              HasSubstr("t.obj:1: the line begins with \"w\": expected v (vertex) or f (face)"));
  EXPECT_THAT(message_of_text("t.obj", ""), HasSubstr("t.obj: the file has no vertex"));
  EXPECT_THAT(message_of_text("t.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"),
              HasSubstr("t.stl:4: the line has only 3 words"));
  EXPECT_THAT(message_of_text("t.stl", "solid\nendsolid\n"),
              HasSubstr("the file has no triangle: expected a surface made of triangles"));
  std::string cut = stl_bytes(stone());
  cut.resize(cut.size() - 1);
  cut[0] = 'b';
  EXPECT_THAT(message_of_text("t.stl", cut),
              testing::ContainsRegex("1?[0-9]+ bytes for [0-9]+ triangles: expected [0-9]+"));
  EXPECT_THAT(
      message_of_text("t.csv", "x,y\n0,0\n"),
      HasSubstr("t.csv:1: the first line is not a header: expected the names of the columns x, y and z"));
  EXPECT_THAT(message_of_text("2.csv", "x,y\n0,0\n1,0,2\n"),
              HasSubstr("2.csv:3: the line has 3 words: expected 2 numbers"));
  EXPECT_THAT(message_of_text("2.csv", "x,y\n0,0\n1,0\n0,1\n0,0\n"), HasSubstr("points 1 and 4 are equal"));
  EXPECT_THAT(message_of_text("t.shp", "name x\n"),
              HasSubstr("t.shp:1: the line begins with \"name\": expected \"<\""));
  EXPECT_THAT(message_of_text("t.shp", "<\nnv 2\n0 0 0\n1 0 0\n"),
              HasSubstr("shape 1 \"\" has no vertices or no radius: expected a line nv N (number of vertices), "
                        "followed by N lines with coordinates, and a line radius R"));
  EXPECT_THAT(message_of_text("t.shp", "<\nradius 0.01\nnv 2\n0 0 0\n1 0 0\n"),
              HasSubstr("51 times as long as it is thick"));
  EXPECT_THAT(message_of_text("t.shp", "<\nradius 0.1\nnv 4\n0 0 0\n1 0 0\n0 1 0\n1 1 0\nnf 1\n4 0 1 3 2\n>\n"),
              HasSubstr("in one plane"));
}

TEST(ShapeFiles, MayHaveLengthsFrom1eMinus50To1e50) {
  const auto expect_volume = [](double unit) {
    Polytope<3> large = stone();
    for (Vec<3>& v : large.vertices) v *= unit;
    const Shape<3> one = parse_shapes<3>("stone.off", off_text(stone()), {.rounding = 0.1})[0].shape;
    const Shape<3> other = parse_shapes<3>("stone.off", off_text(large), {.rounding = 0.1})[0].shape;
    EXPECT_NEAR(other.volume / std::pow(unit, 3), one.volume, 1e-12) << unit;
    for (int a = 0; a < 3; ++a)
      EXPECT_NEAR(other.inertia[a] / std::pow(unit, 5), one.inertia[a], 1e-12) << unit;
  };
  expect_volume(1e49);
  expect_volume(1e-49);
  EXPECT_THAT(message_of_text("2.csv", "x,y\n0,0\n1,0\n0,1e51\n"),
              HasSubstr("2.csv: point 3: expected coordinates that are finite numbers from -1e+50 to 1e+50"));
  EXPECT_THAT(message_of_text("2.csv", "x,y\n0,0\n1e-60,0\n0,2e-60\n"),
              HasSubstr("2.csv: the largest extent of the points is 2e-60: expected at least 1e-50"));
  const std::string ball = "<\nname Ball\nradius RADIUS\nnv 1\n0 0 0\n>\n";
  for (const std::string radius : {"0", "-1", "1e-60", "1e+51"}) {
    std::string text = ball;
    text.replace(text.find("RADIUS"), 6, radius);
    EXPECT_THAT(message_of_text("b.shp", text),
                testing::StartsWith("b.shp:3: the radius of the shape is " + radius))
        << radius;
  }
}

/// Returns the text with bytes changed, duplicated or removed, or with numbers made huge.
std::string mutated(std::string text, RandomStream& random) {
  for (std::uint64_t n = 1 + random.below(4), k = 0; k < n && !text.empty(); ++k) {
    const std::size_t at = random.below(text.size()), length = 1 + random.below(12);
    switch (random.below(5)) {
      case 0:
        text[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(random.below(text.size()), length));
        break;
      case 3:
        text.insert(at, "9999999999999999999");
        break;
      default:
        text[at] = "0123456789-.e \n"[random.below(15)];
        break;
    }
  }
  return text;
}

TEST(ShapeFiles, DamagedAreReadOrRefusedButNothingElse) {
  const Polytope<3> given = stone();
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.off", off_text(given)}, {"a.obj", obj_text(given)},  {"a.csv", csv_text(given)},
      {"a.stl", stl_text(given)}, {"b.stl", stl_bytes(given)}, {"a.shp", shp_text(given)}};
  RandomStream random(6, 1);
  int refused = 0, read = 0;
  for (int k = 0; k < 36000; ++k) {
    const auto& [path, text] = files[k % files.size()];
    const std::string damaged = mutated(text, random);
    try {
      for (const auto& [name, shape, remarks] : parse_shapes<3>(path, damaged)) {
        ASSERT_GT(shape.volume, 0.0) << damaged;
        ASSERT_TRUE(shape.inertia.allFinite()) << damaged;
        ASSERT_EQ(shape.is_round() || shape.n_vertices() == 2 ||
                      shape.n_vertices() - shape.n_edges() + shape.n_faces() == 2,
                  true)
            << damaged;
      }
      ++read;
    } catch (const InputError& error) {
      ASSERT_THAT(error.what(), HasSubstr(path));
      ++refused;
    }
  }
  EXPECT_GT(read, 4000);
  EXPECT_GT(refused, 4000);
}

/// The corners of a cuboid that are furthest from each other are those of a rectangle.
TEST(ShapeFiles, OfACuboidAreTakenWithFourCornersThatSpanAVolume) {
  for (const double height : {0.5, 1.0, 2.0}) {
    const std::string text = off_text(convex_hull<3>(test::box_points(1, 1, height)).polytope);
    const auto few = parse_shapes<3>("box.off", text, {.vertices = 4})[0];
    EXPECT_EQ(few.shape.n_vertices(), 4);
    EXPECT_GE(few.shape.volume, height / 6.0 - 1e-15);
  }
}

}  // namespace
}  // namespace floc
