#include "floc/io/mesh_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "floc/base/error.h"
#include "floc/io/vtk_arrays.h"
#include "floc/io/vtu.h"
#include "floc/shape/mesh_files.h"
#include "floc/shape/surface.h"
#include "support/angular_packing.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Returns the volume enclosed by the oriented faces of a mesh.
double enclosed(const Mesh<3>& mesh) {
  double six = 0.0;
  for (const std::vector<int>& face : mesh.faces)
    for (std::size_t k = 2; k < face.size(); ++k)
      six += mesh.vertices[face[0]].dot(mesh.vertices[face[k - 1]].cross(mesh.vertices[face[k]]));
  return six / 6.0;
}

TEST(SurfaceOfShape, LiesInsideByAtMostASeventhOfTheRounding) {
  for (const Shape<3>& shape : test::rounded_shapes<3>()) {
    const Polytope<3> surface = surface_of(shape);
    Mesh<3> mesh;
    mesh.vertices = surface.vertices, mesh.faces = surface.faces;
    EXPECT_LT(enclosed(mesh), shape.volume);
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
      const std::vector<int>& face = surface.faces[f];
      const Vec<3>& a = surface.vertices[face[0]];
      const Vec<3> n = (surface.vertices[face[1]] - a).cross(surface.vertices[face[2]] - a).normalized();
      double furthest = 0.0;
      for (const Vec<3>& v : shape.vertices) furthest = std::max(furthest, n.dot(v));
      const double support = furthest + shape.rounding;
      EXPECT_LE(n.dot(a), support + 1e-12);
      EXPECT_GE(n.dot(a), support - shape.rounding / 7.0);
    }
  }
}

TEST(SurfaceOfShape, OfSharpGrainsIsExact) {
  const Shape<3> shape = box<3>(Vec<3>(1.0, 2.0, 3.0), 0.0);
  const Polytope<3> surface = surface_of(shape);
  EXPECT_EQ(surface.vertices, shape.vertices);
  EXPECT_EQ(surface.faces.size(), 6u);
}

TEST(MeshText, EnclosesTheVolumeOfTheGrains) {
  const State<3> state = test::angular_packing_with_forces<3>({"p", "p", "p"}, cut_shapes<3>({}, 3, 0.0, 7));
  double volume = 0.0;
  for (int i = 0; i < state.packing.grains.size(); ++i) volume += state.packing.grains.volume(i);
  const test::ScratchDirectory scratch;
  write_obj(scratch.file("p.obj"), state);
  write_stl(scratch.file("p.stl"), state);
  const Mesh<3> obj = parse_obj("p.obj", test::content_of(scratch.file("p.obj")));
  EXPECT_NEAR(enclosed(obj), volume, 1e-12 * volume);
  // floc refuses a file with several solids, so each solid is written to a separate file.
  const std::string stl = test::content_of(scratch.file("p.stl"));
  double of_solids = 0.0;
  for (std::size_t at = 0, end; (end = stl.find("endsolid", at)) != std::string::npos;
       at = stl.find('\n', end) + 1)
    of_solids += enclosed(parse_stl("p.stl", stl.substr(at, stl.find('\n', end) + 1 - at)));
  EXPECT_NEAR(of_solids, volume, 1e-12 * volume);
  const State<2> plane = test::packing_with_forces<2>({"p", "p"});
  EXPECT_THAT([&] { write_obj(scratch.file("q.obj"), plane); },
              ThrowsMessage<InputError>(HasSubstr("two-dimensional")));
}

TEST(MeshText, HasSpheresToo) {
  const State<3> state = test::packing_with_forces<3>({"p", "p", "p"});
  const test::ScratchDirectory scratch;
  write_obj(scratch.file("p.obj"), state);
  double volume = 0.0;
  for (int i = 0; i < state.packing.grains.size(); ++i) volume += state.packing.grains.volume(i);
  const double share = enclosed(parse_obj("p.obj", test::content_of(scratch.file("p.obj")))) / volume;
  EXPECT_GT(share, 0.8);
  EXPECT_LT(share, 1.0);
}

std::vector<double> numbers(const VtkArrays& arrays, const char* section, const char* name) {
  return arrays.read(section, name);
}

TEST(VtuOfShapes, HasAPolyhedronForEachGrainWithCorners) {
  const State<3> state = test::angular_packing_with_forces<3>({"p", "p", "p"});
  const VtkArrays arrays("p.vtu", vtu_text(AnyState(state)));
  const std::vector<double> types = numbers(arrays, "Cells", "types"),
                            faces = numbers(arrays, "Cells", "faces"),
                            ends = numbers(arrays, "Cells", "faceoffsets"), x = arrays.read("Points", ""),
                            forces = numbers(arrays, "CellData", "normal_force");
  ASSERT_EQ(types.size(), ends.size());
  ASSERT_EQ(types.size(), forces.size());
  double volume = 0.0, expected = 0.0;
  int n_polyhedra = 0;
  std::size_t at = 0;
  for (std::size_t cell = 0; cell < types.size(); ++cell) {
    if (types[cell] != 42.0) {
      EXPECT_EQ(ends[cell], -1.0);
      continue;
    }
    ++n_polyhedra;
    Mesh<3> mesh;
    const auto n_faces = static_cast<int>(faces[at++]);
    for (int f = 0; f < n_faces; ++f) {
      mesh.faces.emplace_back();
      for (auto n = static_cast<int>(faces[at++]); n > 0; --n, ++at) {
        const auto point = static_cast<std::size_t>(faces[at]);
        mesh.faces.back().push_back(static_cast<int>(mesh.vertices.size()));
        mesh.vertices.emplace_back(x[3 * point], x[3 * point + 1], x[3 * point + 2]);
      }
    }
    EXPECT_EQ(ends[cell], static_cast<double>(at));
    volume += enclosed(mesh);
  }
  for (int i = 0; i < state.packing.grains.size(); ++i) {
    const PlacedShape<3> placed = state.packing.grains.placed(i);
    if (placed.shape->n_faces() == 0) continue;
    --n_polyhedra;
    const Shape<3>& s = *placed.shape;
    Mesh<3> core;
    core.vertices = s.vertices;
    for (int f = 0; f < s.n_faces(); ++f) core.faces.emplace_back(s.loop(f).begin(), s.loop(f).end());
    expected += std::pow(placed.scale, 3) * enclosed(core);
  }
  EXPECT_EQ(n_polyhedra, 0);
  EXPECT_NEAR(volume, expected, 1e-12 * expected);
}

TEST(VtuOfShapes, OutlinesPolygonsAndLeadsLinesThroughContactPoints) {
  const State<2> state = test::angular_packing_with_forces<2>({"ww", "ww"}, cut_shapes<2>({}, 3, 0.0, 7));
  const VtkArrays arrays("p.vtu", vtu_text(AnyState(state)));
  const std::vector<double> types = numbers(arrays, "Cells", "types"),
                            ends = numbers(arrays, "Cells", "offsets"),
                            points = numbers(arrays, "Cells", "connectivity"), x = arrays.read("Points", ""),
                            forces = numbers(arrays, "CellData", "normal_force");
  double area = 0.0, expected = 0.0;
  std::size_t n_lines = 0;
  double line_force = 0.0;
  for (std::size_t cell = 0; cell < types.size(); ++cell) {
    const auto first = static_cast<std::size_t>(cell == 0 ? 0.0 : ends[cell - 1]);
    const auto last = static_cast<std::size_t>(ends[cell]);
    n_lines += types[cell] == 3.0;
    if (types[cell] == 3.0) line_force += forces[cell];
    if (types[cell] != 7.0) continue;
    for (std::size_t k = first; k < last; ++k) {
      const auto a = static_cast<std::size_t>(points[k]),
                 b = static_cast<std::size_t>(points[k + 1 == last ? first : k + 1]);
      area += 0.5 * (x[3 * a] * x[3 * b + 1] - x[3 * b] * x[3 * a + 1]);
    }
  }
  for (int i = 0; i < state.packing.grains.size(); ++i) expected += state.packing.grains.volume(i);
  EXPECT_NEAR(area, expected, 1e-12 * expected);
  std::size_t lines_expected = 0;
  double force_expected = 0.0;
  for (const Contact<2>& c : state.packing.contacts) {
    const int halves = state.packing.is_wall(c.j) ? 1 : 2;
    lines_expected += static_cast<std::size_t>(halves);
    force_expected += halves * c.normal_force;
  }
  EXPECT_EQ(n_lines, lines_expected);
  EXPECT_NEAR(line_force, force_expected, 1e-12 * force_expected);
}

TEST(VtuOfShapes, AreNotTakenForSpheresWhenTheyAreRead) {
  const test::ScratchDirectory scratch;
  test::write_text(scratch.file("p.vtu"), vtu_text(AnyState(test::angular_packing_with_forces<2>({"p", "p"}))));
  ImportOptions with_cell;
  with_cell.cell = {{4.0, 0.0}, {0.0, 4.0}};
  for (const ImportOptions& options : {ImportOptions{}, with_cell})
    EXPECT_THAT([&] { test::read_packing<2>(scratch.file("p.vtu"), options); },
                ThrowsMessage<InputError>(HasSubstr("the grains of this file have corners")));
}

}  // namespace
}  // namespace floc
