#include "floc/io/state_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/io/state_file.h"
#include "floc/shape/shape_fault.h"
#include "support/rigid_states.h"
#include "support/scratch_directory.h"
#include "support/sealed.h"

namespace floc::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

template <int Dim>
void expect_same(const Shape<Dim>& a, const Shape<Dim>& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.first_corner, b.first_corner);
  EXPECT_EQ(a.vertex_faces, b.vertex_faces);
  EXPECT_EQ(a.first_of_vertex, b.first_of_vertex);
  ASSERT_EQ(a.n_edges(), b.n_edges());
  for (int e = 0; e < a.n_edges(); ++e) {
    const ShapeEdge &p = a.edges[e], &q = b.edges[e];
    EXPECT_EQ(std::tie(p.from, p.to, p.left, p.right), std::tie(q.from, q.to, q.left, q.right));
  }
  EXPECT_EQ(std::tie(a.rounding, a.volume, a.outer_radius, a.inner_radius),
            std::tie(b.rounding, b.volume, b.outer_radius, b.inner_radius));
  EXPECT_EQ(a.inertia, b.inertia);
  EXPECT_EQ(a.centre, b.centre);
  EXPECT_EQ(a.axes, b.axes);
}

/// Returns a state with a row of grains, one of each shape. The first two grains have two contact points.
template <int Dim>
State<Dim> state_of(std::vector<Shape<Dim>> shapes) {
  State<Dim> state;
  state.packing.law = rigid_law(0.3);
  const int n = static_cast<int>(shapes.size());
  state.packing.cell.matrix = 2.0 * n * Mat<Dim>::Identity();
  Grains<Dim>& g = state.packing.grains;
  g = Grains<Dim>::with_size(n);
  for (int i = 0; i < n; ++i) {
    g.position[i] = 0.7 * Vec<Dim>::Ones() + 1.7 * i * Vec<Dim>::Unit(0);
    g.shape.push_back(i);
    g.scale.push_back(1.0 + 0.1 / (i + 3.0));
    g.radius[i] = g.scale[i] * shapes[i].outer_radius;
    if constexpr (Dim == 2) g.orientation[i] = 0.3 * i;
  }
  g.shapes = std::make_shared<const std::vector<Shape<Dim>>>(std::move(shapes));
  for (int i = 0; i < n; ++i) g.mass[i] = g.volume(i);
  for (const std::uint32_t key : {0xFFFFFFFEu, 5u}) {
    Contact<Dim> c;
    c.j = 1;
    c.key = static_cast<int>(key);
    c.gap = -1e-7 / 3.0;
    c.normal = Vec<Dim>::Unit(0);
    c.arm_i = Vec<Dim>::Constant(0.1 / (c.key % 7 + 9.0));
    c.arm_j = c.arm_i - branch(state.packing, c);
    c.normal_force = c.elastic_force = 0.7 / 3.0;
    c.type = ContactType::kFaceFace;
    state.packing.contacts.push_back(c);
  }
  measure(state);
  return state;
}

std::vector<Shape<2>> shapes_in_2d() {
  std::vector<Shape<2>> all = {regular_polygon(5, 0.0), regular_polygon(8, 0.1), box<2>(Vec<2>(1.0, 2.0), 0.05),
                               capsule<2>(2.5), capsule<2>(1.0)};
  for (const Shape<2>& s : hull_shapes<2>({.least_vertices = 5, .most_vertices = 9}, 3, 0.02, 7))
    all.push_back(s);
  for (const Shape<2>& s : cut_shapes<2>({}, 3, 0.0, 7)) all.push_back(s);
  for (const Shape<2>& s : voronoi_shapes<2>({.cells = 20}, 3, 0.1, 7)) all.push_back(s);
  return all;
}

std::vector<Shape<3>> shapes_in_3d() {
  std::vector<Shape<3>> all = {box<3>(Vec<3>(1.0, 2.0, 3.0), 0.0), box<3>(Vec<3>(1.0, 1.0, 1.0), 0.1),
                               capsule<3>(2.5), capsule<3>(1.0)};
  for (const Shape<3>& s : hull_shapes<3>({}, 3, 0.02, 7)) all.push_back(s);
  for (const Shape<3>& s : cut_shapes<3>({}, 3, 0.0, 7)) all.push_back(s);
  for (const Shape<3>& s : voronoi_shapes<3>({.cells = 20}, 3, 0.1, 7)) all.push_back(s);
  return all;
}

template <int Dim>
void expect_kept(const State<Dim>& saved, const std::string& progress) {
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), saved, progress);
  EXPECT_EQ(read_progress(scratch.file("s.h5")), progress);
  const State<Dim> read = std::get<State<Dim>>(read_state(scratch.file("s.h5")));
  const Grains<Dim>&a = saved.packing.grains, &b = read.packing.grains;
  ASSERT_EQ(a.shapes->size(), b.shapes->size());
  for (std::size_t s = 0; s < a.shapes->size(); ++s) expect_same((*a.shapes)[s], (*b.shapes)[s]);
  EXPECT_EQ(std::tie(a.shape, a.scale, a.radius, a.mass), std::tie(b.shape, b.scale, b.radius, b.mass));
  ASSERT_EQ(saved.packing.contacts.size(), read.packing.contacts.size());
  for (std::size_t k = 0; k < saved.packing.contacts.size(); ++k) {
    const Contact<Dim>&c = saved.packing.contacts[k], &d = read.packing.contacts[k];
    EXPECT_EQ(std::tie(c.i, c.j, c.key, c.gap, c.type, c.normal_force, c.elastic_force, c.kn, c.kt),
              std::tie(d.i, d.j, d.key, d.gap, d.type, d.normal_force, d.elastic_force, d.kn, d.kt));
    EXPECT_EQ(c.normal, d.normal);
    EXPECT_EQ(c.arm_i, d.arm_i);
    EXPECT_EQ(c.arm_j, d.arm_j);
  }
  EXPECT_EQ(read.packing.law, saved.packing.law);
}

TEST(StateWithShapes, ComesBackAsItWas) {
  expect_kept(state_of(shapes_in_2d()), "");
  expect_kept(state_of(shapes_in_3d()), "");
  expect_kept(state_of(shapes_in_3d()), "{\"phase\": \"load\"}");
  expect_kept(brick_bond(0.7, 0.3), "");
}

TEST(StateWithShapes, NamesItsFeatures) {
  const ScratchDirectory scratch;
  const auto features = [&](const auto& state) {
    write_state(scratch.file("s.h5"), state);
    const Hdf5Reader file(scratch.file("s.h5"), scratch.file("s.h5"));
    std::string text;
    file.attribute("/", "features", text);
    return text;
  };
  EXPECT_EQ(features(brick_bond(1.0, 0.3)), "shapes rigid");
  EXPECT_EQ(features(triangular_crystal(1.0, 0.3)), "rigid");
}

TEST(StateOfRigidGrains, OfRoundGrainsComesBackAsItWas) {
  const State<3> saved = cubic_crystal(0.3, 0.4);
  const ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), saved);
  const State<3> read = std::get<State<3>>(read_state(scratch.file("s.h5")));
  EXPECT_TRUE(read.packing.law.is_rigid());
  ASSERT_EQ(read.packing.contacts.size(), 81u);
  for (std::size_t k = 0; k < 81; ++k) {
    EXPECT_EQ(read.packing.contacts[k].normal_force, saved.packing.contacts[k].normal_force);
    EXPECT_EQ(read.packing.contacts[k].arm_i, saved.packing.contacts[k].arm_i);
  }
}

/// Changes the content of a state file with the HDF5 library, and seals it again.
class Spoiled {
 public:
  explicit Spoiled(const State<3>& state) : path_(scratch_.file("s.h5")) {
    write_state(path_, state);
    const std::string content = without_seal(read_file(path_));
    std::ofstream(path_, std::ios::binary) << content;
    file_ = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  }
  Spoiled& remove(const std::string& dataset) {
    H5Ldelete(file_, dataset.c_str(), H5P_DEFAULT);
    return *this;
  }
  /// Removes the last row of a dataset.
  Spoiled& shorten(const std::string& dataset) {
    const hid_t old = H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), space = H5Dget_space(old);
    hsize_t size[2] = {0, 0};
    const int rank = H5Sget_simple_extent_dims(space, size, nullptr);
    --size[0];
    const hid_t type = H5Dget_type(old), smaller = H5Screate_simple(rank, size, nullptr);
    H5Dclose(old);
    remove(dataset);
    H5Dclose(H5Dcreate2(file_, dataset.c_str(), type, smaller, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Sclose(smaller), H5Sclose(space), H5Tclose(type);
    return *this;
  }
  template <class T>
  Spoiled& set(const std::string& dataset, std::size_t entry, T value) {
    const hid_t type = std::is_same_v<T, double> ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT32;
    const hid_t data = H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), space = H5Dget_space(data);
    std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    values.at(entry) = value;
    H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space), H5Dclose(data);
    return *this;
  }
  void expect_refused(const std::string& dataset, const std::string& words = "") {
    H5Fclose(file_);
    const std::string content = read_file(path_);
    std::ofstream(path_, std::ios::binary) << sealed(content);
    EXPECT_THAT([&] { read_state(path_); },
                ThrowsMessage<InputError>(AllOf(HasSubstr(":/" + dataset), HasSubstr(words))))
        << dataset << " " << words;
  }

 private:
  ScratchDirectory scratch_;
  std::string path_;
  hid_t file_;
};

State<3> cubes() {
  return state_of<3>({box<3>(Vec<3>(1.0, 1.0, 1.0), 0.0), box<3>(Vec<3>(1.0, 2.0, 3.0), 0.1)});
}

TEST(StateWithShapes, IsRefusedIfADatasetIsMissingOrShort) {
  for (const std::string name :
       {"first_vertex", "vertices", "first_face", "first_corner", "faces", "normals", "offsets", "rounding",
        "volume", "inertia", "outer_radius", "inner_radius", "centre", "axes"}) {
    Spoiled(cubes()).remove("shapes/" + name).expect_refused("shapes/" + name);
    Spoiled(cubes()).shorten("shapes/" + name).expect_refused("shapes/");
  }
  for (const std::string name : {"grains/shape", "grains/scale", "contacts/point", "contacts/type"}) {
    Spoiled(cubes()).remove(name).expect_refused(name);
    Spoiled(cubes()).shorten(name).expect_refused(name);
  }
}

TEST(StateWithShapes, IsRefusedIfAnIndexIsOutOfRange) {
  Spoiled(cubes()).set("shapes/first_vertex", 1, 17).expect_refused("shapes/first_vertex", "entry 1 is 17");
  Spoiled(cubes()).set("shapes/first_face", 1, -1).expect_refused("shapes/first_face", "ascend");
  Spoiled(cubes()).set("shapes/first_corner", 2, 1).expect_refused("shapes/first_corner", "ascend");
  Spoiled(cubes())
      .set("shapes/faces", 3, 8)
      .expect_refused("shapes/faces", "it has the vertex 8: expected vertices from 0 to 7");
  Spoiled(cubes()).set("shapes/faces", 3, -1).expect_refused("shapes/faces", "vertex -1");
  Spoiled(cubes()).set("grains/shape", 1, 2).expect_refused("grains/shape", "expected a shape from 0 to 1");
  Spoiled(cubes()).set("contacts/type", 1, 4).expect_refused("contacts/type", "entry 1 is 4");
  Spoiled(cubes()).set("contacts/key", 0, 5).expect_refused("contacts/key", "ascending order");
}

TEST(StateWithShapes, IsRefusedIfAShapeIsNoConvexBody) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::string name : {"vertices", "normals", "offsets", "rounding", "volume", "inertia",
                                 "outer_radius", "inner_radius", "centre", "axes"})
    Spoiled(cubes()).set("shapes/" + name, 1, nan).expect_refused("shapes/" + name, "finite");
  Spoiled(cubes()).set("grains/scale", 1, nan).expect_refused("grains/scale", "finite");
  Spoiled(cubes()).set("contacts/point", 1, nan).expect_refused("contacts/point", "finite");
  // A cube whose vertex was moved has normals that do not fit its faces.
  Spoiled(cubes()).set("shapes/vertices", 0, 0.9).expect_refused("shapes/", "shape 0");
  Spoiled(cubes()).set("shapes/normals", 0, 0.9).expect_refused("shapes/normals", "not normal");
  Spoiled(cubes()).set("shapes/offsets", 0, 0.9).expect_refused("shapes/offsets", "face 0");
  Spoiled(cubes()).set("shapes/rounding", 1, -0.1).expect_refused("shapes/rounding", "expected");
  Spoiled(cubes()).set("shapes/volume", 1, 0.3).expect_refused("shapes/volume", "shape 1");
  Spoiled(cubes()).set("shapes/inertia", 1, 0.3).expect_refused("shapes/inertia", "component 1");
  Spoiled(cubes()).set("shapes/outer_radius", 0, 0.6).expect_refused("shapes/outer_radius");
  Spoiled(cubes()).set("shapes/inner_radius", 0, 0.6).expect_refused("shapes/inner_radius");
  Spoiled(cubes()).set("grains/scale", 0, 0.6).expect_refused("grains/radius", "outer radius");
  Spoiled(cubes()).set("grains/scale", 0, -0.6).expect_refused("grains/scale", "positive");
}

TEST(StateWithShapes, IsRefusedIfItsPolygonIsNotConvex) {
  // A pentagram has the same vertices as a pentagon, but its outline visits them in another order.
  Shape<2> star = regular_polygon(5, 0.0);
  star.corners = {0, 2, 2, 4, 4, 1, 1, 3, 3, 0};
  EXPECT_FALSE(fault_of_faces(star));
  const auto fault = fault_of_geometry(star);
  ASSERT_TRUE(fault);
  EXPECT_STREQ(fault->member, "normals");
  Shape<2> turned = regular_polygon(5, 0.0);
  turned.corners = {1, 0, 2, 1, 3, 2, 4, 3, 0, 4};
  EXPECT_TRUE(fault_of_faces(turned));
}

}  // namespace
}  // namespace floc::test
