#include "floc/scene/read_shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "floc/assembly/draw_shapes.h"
#include "floc/base/error.h"
#include "floc/base/sha256.h"
#include "floc/loading/run.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_warnings.h"
#include "support/message_of.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string text_with_shape(const std::string& shape, int dimension, double solid_fraction = 0.05) {
  return "[scene]\ndimension = " + std::to_string(dimension) +
         "\nunits = \"reduced\"\n[grains]\ncount = 20\ndiameter = {distribution = \"constant\", value = "
         "1.0}\nshape = " +
         shape +
         "\n[contact]\nnormal = {law = \"rigid\"}\nfriction = {coefficient = 0.5}\n[cell]\nsolid_fraction = " +
         std::to_string(solid_fraction) + "\n[assembly]\nprotocol = \"direct\"\npressure = 1.0\n";
}

Scene shaped(const std::string& shape, int dimension, const std::string& directory = ".") {
  return parse_scene(text_with_shape(shape, dimension), "s.toml", directory);
}

std::string shape_faults(const std::string& shape, int dimension, const std::string& directory = ".",
                         const std::vector<std::string>& overrides = {}) {
  return test::message_of(
      [&] { parse_scene(text_with_shape(shape, dimension), "s.toml", directory, overrides); });
}

template <class Kind>
Kind shape_of_kind(const std::string& shape, int dimension) {
  return std::get<Kind>(shaped(shape, dimension).grains.shape->kind);
}

TEST(ReadShape, EveryKeyArrives) {
  EXPECT_EQ(shape_of_kind<PolygonOptions>("{kind = \"polygon\", sides = 7}", 2).sides, 7);
  EXPECT_EQ(shape_of_kind<BoxShapeOptions>("{kind = \"box\", sides = [1, 2, 3]}", 3).sides,
            (std::vector<double>{1, 2, 3}));
  const auto hull = shape_of_kind<HullOptions>("{kind = \"hull\", vertices = [8, 10], aspect = 2}", 3);
  EXPECT_EQ(hull.least_vertices, 8);
  EXPECT_EQ(hull.most_vertices, 10);
  EXPECT_EQ(hull.aspect, 2.0);
  const auto cut = shape_of_kind<CutOptions>("{kind = \"cut\", faces = 12, spread = 0.1}", 3);
  EXPECT_EQ(cut.least_faces, 12);
  EXPECT_EQ(cut.most_faces, 12);
  EXPECT_EQ(cut.spread, 0.1);
  const auto cells = shape_of_kind<VoronoiOptions>("{kind = \"voronoi\", cells = 80, relaxed = 1}", 2);
  EXPECT_EQ(cells.cells, 80);
  EXPECT_EQ(cells.relaxed, 1);
  EXPECT_EQ(shape_of_kind<CapsuleOptions>("{kind = \"capsule\", aspect = 3}", 2).aspect, 3.0);
  const Scene scene = shaped("{kind = \"cut\", rounding = 0.05, count = 7}", 3);
  EXPECT_EQ(scene.grains.shape->rounding, 0.05);
  EXPECT_EQ(scene.grains.shape->count, 7);
}

TEST(ReadShape, KeysLeftOutHaveTheDefaultsOfTheGenerators) {
  const auto hull = shape_of_kind<HullOptions>("{kind = \"hull\"}", 3);
  EXPECT_EQ(hull.least_vertices, HullOptions{}.least_vertices);
  EXPECT_EQ(hull.most_vertices, HullOptions{}.most_vertices);
  EXPECT_EQ(shape_of_kind<CutOptions>("{kind = \"cut\"}", 3).spread, CutOptions{}.spread);
  EXPECT_EQ(shape_of_kind<VoronoiOptions>("{kind = \"voronoi\"}", 2).cells, VoronoiOptions{}.cells);
  EXPECT_EQ(shaped("{kind = \"cut\"}", 3).grains.shape->count, ShapeOptions{}.count);
}

struct BadShape {
  const char* shape;
  int dimension;
  const char* fault;
};
void PrintTo(const BadShape& bad, std::ostream* out) {
  *out << bad.dimension << "D " << bad.shape;
}

class BadShapes : public testing::TestWithParam<BadShape> {};

TEST_P(BadShapes, AreRefusedWithPlaceKeyAndExpectation) {
  const BadShape& bad = GetParam();
  const std::string words = shape_faults(bad.shape, bad.dimension);
  EXPECT_THAT(words, testing::StartsWith("s.toml:7: ")) << words;
  EXPECT_THAT(words, HasSubstr(bad.fault)) << words;
  EXPECT_THAT(words, Not(HasSubstr("\n"))) << words;
}

INSTANTIATE_TEST_SUITE_P(
    Kind, BadShapes,
    testing::Values(
        BadShape{"5", 2, "grains.shape = 5: expected a table"},
        BadShape{"{sides = 5}", 2, "grains.shape.kind is missing: expected \"polygon\""},
        BadShape{"{kind = 1}", 2, "grains.shape.kind = 1: expected \"polygon\""},
        BadShape{"{kind = \"polygn\"}", 2, "grains.shape.kind = 'polygn': expected \"polygon\", \"box\""},
        BadShape{"{kind = \"polygon\", sides = 5}", 3, "polygons exist in two dimensions only"},
        BadShape{"{kind = \"box\", sides = [1, 2]}", 3, "grains.shape.sides has 2 numbers: expected 3"},
        BadShape{"{kind = \"box\", sides = [1, 2, 3]}", 2, "grains.shape.sides has 3 numbers: expected 2"}));

INSTANTIATE_TEST_SUITE_P(Missing, BadShapes,
                         testing::Values(BadShape{"{kind = \"polygon\"}", 2, "grains.shape.sides is missing"},
                                         BadShape{"{kind = \"box\"}", 2, "grains.shape.sides is missing"},
                                         BadShape{"{kind = \"capsule\"}", 2, "grains.shape.aspect is missing"},
                                         BadShape{"{kind = \"file\"}", 2, "grains.shape.file is missing"}));

INSTANTIATE_TEST_SUITE_P(
    Type, BadShapes,
    testing::Values(
        BadShape{"{kind = \"polygon\", sides = \"five\"}", 2,
                 "grains.shape.sides = 'five': expected the number"},
        BadShape{"{kind = \"polygon\", sides = 5.0}", 2, "written without a decimal point"},
        BadShape{"{kind = \"polygon\", sides = [1, 1]}", 2, "expected the number of sides"},
        BadShape{"{kind = \"box\", sides = 1}", 2, "grains.shape.sides = 1: expected an array"},
        BadShape{"{kind = \"box\", sides = [1, \"a\"]}", 2, "expected an array"},
        BadShape{"{kind = \"hull\", vertices = \"many\"}", 3, "grains.shape.vertices = 'many': expected"},
        BadShape{"{kind = \"hull\", vertices = [12, 24, 30]}", 3, "expected the number of points"},
        BadShape{"{kind = \"hull\", vertices = [12, 24.5]}", 3, "expected the number of points"},
        BadShape{"{kind = \"hull\", vertices = 3000000000}", 3, "expected the number of points"},
        BadShape{"{kind = \"hull\", aspect = [1, 2]}", 3, "grains.shape.aspect = [ 1, 2 ]: expected a number"},
        BadShape{"{kind = \"cut\", faces = 10.5}", 3, "grains.shape.faces = 10.5: expected"},
        BadShape{"{kind = \"cut\", spread = \"x\"}", 3, "grains.shape.spread = 'x': expected a number"},
        BadShape{"{kind = \"voronoi\", cells = 1.5}", 3, "grains.shape.cells = 1.5: expected"},
        BadShape{"{kind = \"voronoi\", relaxed = \"x\"}", 3, "grains.shape.relaxed = 'x': expected"},
        BadShape{"{kind = \"capsule\", aspect = \"x\"}", 3, "grains.shape.aspect = 'x': expected"},
        BadShape{"{kind = \"cut\", rounding = \"x\"}", 3, "grains.shape.rounding = 'x': expected a number"},
        BadShape{"{kind = \"cut\", rounding = nan}", 3, "grains.shape.rounding = nan: expected a number"},
        BadShape{"{kind = \"cut\", count = 2.5}", 3, "grains.shape.count = 2.5: expected"},
        BadShape{"{kind = \"file\", file = 1}", 3, "grains.shape.file = 1: expected the name of a file"},
        BadShape{"{kind = \"file\", file = \"a.off\", vertices = \"x\"}", 3, "grains.shape.vertices = 'x'"},
        BadShape{"{kind = \"file\", file = \"a.off\", sha256 = 1}", 3, "grains.shape.sha256 = 1"}));

INSTANTIATE_TEST_SUITE_P(
    Range, BadShapes,
    testing::Values(
        BadShape{"{kind = \"polygon\", sides = 2}", 2,
                 "grains.shape.sides = 2: expected a whole number from 3"},
        BadShape{"{kind = \"polygon\", sides = 201}", 2, "grains.shape.sides = 201: expected"},
        BadShape{"{kind = \"polygon\", sides = 5, rounding = 0.5}", 2, "grains.shape.rounding = 0.5: expected"},
        BadShape{"{kind = \"box\", sides = [1, 0]}", 2,
                 "grains.shape.sides[1] = 0: expected a positive number"},
        BadShape{"{kind = \"box\", sides = [1, 30]}", 2, "grains.shape: the shape is 30 times as long"},
        BadShape{"{kind = \"hull\", vertices = [3, 24]}", 3, "grains.shape.vertices[0] = 3: expected a whole"},
        BadShape{"{kind = \"hull\", vertices = [12, 500]}", 3, "grains.shape.vertices[1] = 500: expected"},
        BadShape{"{kind = \"hull\", vertices = [24, 12]}", 3, "expected the smaller number first"},
        BadShape{"{kind = \"hull\", aspect = 11}", 3,
                 "grains.shape.aspect = 11: expected a number from 1 to 10"},
        BadShape{"{kind = \"cut\", faces = [2, 5]}", 2, "grains.shape.faces[0] = 2: expected"},
        BadShape{"{kind = \"cut\", spread = 1.5}", 3,
                 "grains.shape.spread = 1.5: expected a number from 0 to 1"},
        BadShape{"{kind = \"voronoi\", cells = 7}", 3,
                 "grains.shape.cells = 7: expected a whole number from 8"},
        BadShape{"{kind = \"voronoi\", relaxed = -1}", 3, "grains.shape.relaxed = -1: expected"},
        BadShape{"{kind = \"voronoi\", cells = 20}", 2, "grains.shape.count = 60: expected at most 20"},
        BadShape{"{kind = \"capsule\", aspect = 0.5}", 3,
                 "grains.shape.aspect = 0.5: expected a number from 1"},
        BadShape{"{kind = \"cut\", count = 0}", 3, "grains.shape.count = 0: expected"},
        BadShape{"{kind = \"cut\", rounding = -0.1}", 3, "grains.shape.rounding = -0.1: expected"},
        BadShape{"{kind = \"file\", file = \"no.off\"}", 3, "grains.shape.file: ./no.off: No such file"}));

INSTANTIATE_TEST_SUITE_P(
    Key, BadShapes,
    testing::Values(
        BadShape{"{kind = \"hull\", vertexes = 12}", 3,
                 "unknown key grains.shape.vertexes; the nearest valid key in [grains.shape] is vertices"},
        BadShape{"{kind = \"cut\", vertices = 12}", 3,
                 "shapes of kind = \"cut\" have no key vertices; expected kind = \"hull\" or \"file\""},
        BadShape{"{kind = \"hull\", faces = 12}", 3,
                 "have no key faces; expected kind = \"cut\", or no key faces"},
        BadShape{"{kind = \"cut\", sides = 12}", 3, "expected kind = \"polygon\" or \"box\", or no key sides"},
        BadShape{"{kind = \"cut\", aspect = 1.2}", 3, "expected kind = \"hull\" or \"capsule\""},
        BadShape{"{kind = \"cut\", cells = 12}", 3, "expected kind = \"voronoi\", or no key cells"},
        BadShape{"{kind = \"cut\", relaxed = 2}", 3, "expected kind = \"voronoi\", or no key relaxed"},
        BadShape{"{kind = \"cut\", file = \"a\"}", 3, "expected kind = \"file\", or no key file"},
        BadShape{"{kind = \"cut\", sha256 = \"a\"}", 3, "expected kind = \"file\", or no key sha256"},
        BadShape{"{kind = \"hull\", spread = 0.1}", 3, "expected kind = \"cut\", or no key spread"},
        BadShape{"{kind = \"capsule\", aspect = 2, rounding = 0.1}", 3, "have no key rounding"},
        BadShape{"{kind = \"polygon\", sides = 5, count = 3}", 2,
                 "have no key count; expected kind = \"hull\""}));

TEST(ReadShape, AGasDenserThanItsCircumscribedBallsAllowIsRefused) {
  const std::string pentagon = "{kind = \"polygon\", sides = 5}";
  // The circumscribed circles may fill at most 0.6 of the cell. A pentagon fills 0.757 of its circumscribed circle, so
  // the largest solid fraction is 0.757 * 0.6 = 0.454.
  EXPECT_NO_THROW(parse_scene(text_with_shape(pentagon, 2, 0.45), "s.toml", "."));
  EXPECT_THAT([&] { parse_scene(text_with_shape(pentagon, 2, 0.46), "s.toml", "."); },
              testing::ThrowsMessage<InputError>(AllOf(HasSubstr("s.toml:12: cell.solid_fraction = 0.46: "),
                                                       HasSubstr("up to the solid fraction 0.4541"))));
}

TEST(ReadShape, AFileIsFoundBesideTheSceneAndItsRemarksAreWarnings) {
  const test::ScratchDirectory scratch;
  std::ofstream(scratch.file("square.csv")) << "x,y\n0,0\n1,0\n1,1\n0,1\n0.5,0.5\n";
  const std::string shape = "{kind = \"file\", file = \"square.csv\"}";
  const Scene scene = shaped(shape, 2, scratch.path());
  EXPECT_THAT(scene_warnings(scene), testing::ElementsAre(AllOf(HasSubstr("square.csv: "),
                                                                HasSubstr("1 of 5 points are not vertices"))));
  // The stored text of the scene contains a hash of the shape file. The scene is therefore refused after the file has
  // changed.
  const std::string sha256 = sha256_of_file(scratch.file("square.csv"));
  EXPECT_THAT(scene.text, HasSubstr(sha256));
  EXPECT_NO_THROW(parse_scene(scene.text, "s.toml", scratch.path()));
  std::ofstream(scratch.file("square.csv")) << "x,y\n0,0\n1,0\n0,1\n";
  EXPECT_THAT([&] { parse_scene(scene.text, "s.toml", scratch.path()); },
              testing::ThrowsMessage<InputError>(HasSubstr("grains.shape.sha256 = " + sha256)));
  EXPECT_THROW(draw_shapes<2>(*scene.grains.shape, 1), InputError);
  EXPECT_THAT(scene_warnings(shaped(shape, 2, scratch.path())), IsEmpty());
}

TEST(ReadShape, ABrokenFileIsNamed) {
  const test::ScratchDirectory scratch;
  std::ofstream(scratch.file("line.csv")) << "x,y\n0,0\n1,0\n2,0\n";
  EXPECT_THAT(shape_faults("{kind = \"file\", file = \"line.csv\"}", 2, scratch.path()),
              AllOf(HasSubstr("s.toml:7: grains.shape.file: "), HasSubstr("line.csv")));
  EXPECT_THAT(shape_faults("{kind = \"file\", file = \"line.csv\", sha256 = \"ab\"}", 2, scratch.path()),
              HasSubstr("grains.shape.sha256 = ab: the file "));
}

/// Returns the faults of a scene of elastic pentagons with further changes.
std::string elastic_faults(const std::vector<std::string>& changes) {
  std::vector<std::string> all = {"contact.normal={law=\"linear\", stiffness=1e4}",
                                  "contact.friction.stiffness=1e4"};
  all.insert(all.end(), changes.begin(), changes.end());
  return shape_faults("{kind = \"polygon\", sides = 5}", 2, ".", all);
}

TEST(ReadShape, ElasticShapesHaveLinearSprings) {
  EXPECT_THAT(shape_faults("{kind = \"capsule\", aspect = 2}", 3, ".",
                           {"contact.normal={law=\"hertz\", modulus=1e4, poisson=0.3}",
                            "contact.friction={law=\"mindlin\", coefficient=0.5}"}),
              AllOf(HasSubstr("contact.normal is not allowed with elastic contacts of grains with shapes"),
                    HasSubstr("contact.friction is not allowed with elastic contacts of grains with shapes")));
  EXPECT_THAT(elastic_faults({"contact.adhesion={law=\"constant\", force=1}"}),
              HasSubstr("contact.adhesion is not allowed with elastic contacts of grains with shapes"));
  EXPECT_THAT(elastic_faults({"contact.damping={restitution=0.5}"}),
              HasSubstr("contact.damping is not allowed"));
  EXPECT_THAT(elastic_faults({"contact.rolling={coefficient=0.1, stiffness=1}"}),
              HasSubstr("contact.rolling is not allowed"));
}

TEST(ReadShape, ElasticShapesHaveSettingsOfContactDynamics) {
  for (const char* key : {"finish=\"closest\"", "restitution=0.5", "gap_tolerance=1e-3"})
    EXPECT_THAT(elastic_faults({std::string("dynamics.") + key}),
                HasSubstr("it is a setting of rigid contacts"))
        << key;
  EXPECT_THAT(elastic_faults({"dynamics.method=\"smooth\""}),
              HasSubstr("dynamics.method = \"smooth\": the contact forces of"));
  for (const char* change : {"run.time_step=0.1", "equilibrium.finish=\"dynamic\""})
    EXPECT_THAT(elastic_faults({change}), HasSubstr("is not allowed with shapes of grains")) << change;
  EXPECT_THAT(elastic_faults({"assembly.vibration={dilation=1.01, collisions=10}"}),
              HasSubstr("assembly.vibration is not allowed with elastic contacts"));
}

TEST(ReadShape, SharpCornersOfElasticGrainsAreWarnedOf) {
  const std::vector<std::string> elastic = {"contact.normal={law=\"linear\", stiffness=1e4}",
                                            "contact.friction.stiffness=1e4"};
  const auto warnings = [&](const std::string& shape, const std::vector<std::string>& overrides) {
    const std::vector<std::string> all =
        scene_warnings(parse_scene(text_with_shape(shape, 2), "s.toml", ".", overrides));
    return std::ranges::count_if(
        all, [](const std::string& w) { return w.find("sharp corners") != std::string::npos; });
  };
  EXPECT_EQ(warnings("{kind = \"polygon\", sides = 5}", elastic), 1);
  EXPECT_EQ(warnings("{kind = \"polygon\", sides = 5, rounding = 0.05}", elastic), 0);
  EXPECT_EQ(warnings("{kind = \"polygon\", sides = 5}", {}), 0);
}

TEST(ReadShape, ElasticShapesAreStrainedUnderAStress) {
  EXPECT_EQ(elastic_faults({"load=[{name=\"shear\", control=\"simple_shear\", strain=0.1, steps=1}]"}), "");
  EXPECT_THAT(
      elastic_faults({"load=[{name=\"undrained\", control=\"constant_volume\", strain=0.1, steps=1}]"}),
      HasSubstr("elastic grains with shapes need a stress on at least one axis in this version of floc, "
                "because their time step and their tolerances are relative to it"));
}

TEST(ReadShape, ARunStartsFromAGasOfTheShapes) {
  const floc::Run<2> run(shaped("{kind = \"polygon\", sides = 6}", 2));
  const Packing<2>& gas = run.packing();
  ASSERT_FALSE(gas.grains.are_round());
  EXPECT_EQ(gas.grains.shapes->front().n_vertices(), 6);
  EXPECT_NEAR(solid_fraction(gas), 0.05, 1e-14);
  EXPECT_TRUE(gas.law.is_rigid());
}

double shape_group(const Scene& scene, const std::string& name) {
  for (const DerivedGroup& g : derived_groups(scene))
    if (g.name == name) return g.value;
  return std::nan("");
}

TEST(ReadShape, GroupsDescribeTheDrawnShapes) {
  const Scene squares = shaped("{kind = \"box\", sides = [1, 2]}", 2);
  // A rectangle with sides 1 and 2 has the diagonal sqrt(5), which is the diameter of its circumscribed circle.
  EXPECT_EQ(shape_group(squares, "n_shapes"), 1.0);
  EXPECT_NEAR(shape_group(squares, "V/V_ball"), 2.0 / (1.25 * std::numbers::pi), 1e-14);
  EXPECT_NEAR(shape_group(squares, "aspect"), 2.0, 1e-14);
  // The mass is the volume times the density at which a disk of diameter 1 has the mass 1.
  EXPECT_NEAR(shape_group(squares, "T"), std::sqrt(2.0 / (1.25 * std::numbers::pi)), 1e-14);
  EXPECT_NEAR(shape_group(shaped("{kind = \"capsule\", aspect = 3}", 3), "aspect"), 3.0, 1e-14);
  EXPECT_EQ(shape_group(shaped("{kind = \"hull\", count = 9}", 3), "n_shapes"), 9.0);
}

}  // namespace
}  // namespace floc
