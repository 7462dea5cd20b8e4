#include "floc/io/state_shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/packing/contact_order.h"
#include "floc/shape/shape_adjacency.h"
#include "floc/shape/shape_fault.h"

namespace floc {
namespace {

constexpr Field kFirstVertex = {
    "shapes/first_vertex", Quantity::count,
    "row in shapes/vertices of the first vertex of each shape, then the number of rows"};
constexpr Field kVertices = {
    "shapes/vertices", Quantity::length,
    "vertices of each core (the shape without its rounding), one shape after the other, about "
    "the centre of mass and along the principal axes of the shape"};
constexpr Field kFirstFace = {"shapes/first_face", Quantity::count,
                              "index of the first face of each shape, then the number of faces"};
constexpr Field kFirstCorner = {
    "shapes/first_corner", Quantity::count,
    "row in shapes/faces of the first vertex of each face, then the number of rows"};
constexpr Field kFaces = {
    "shapes/faces", Quantity::count,
    "vertices around each face, counter-clockwise as seen from outside, one face after the "
    "other; 0: the first vertex of the shape"};
constexpr Field kNormals = {"shapes/normals", Quantity::direction, "outward unit normal n of each face"};
constexpr Field kOffsets = {"shapes/offsets", Quantity::length, "n . x of the points x on each face"};

constexpr Field kAxes = {
    "shapes/axes", Quantity::ratio,
    "for each shape, row by row, the matrix whose columns are the axes of the vertices in the "
    "coordinates from which the shape was made"};

/// Largest accepted relative difference between the radius of a grain in the file and the radius computed from the
/// shape and the scale of the grain.
constexpr double kRadiusError = 1e-12;
/// Largest accepted number of shapes, faces or vertices in a file. Indices are of type int, which may be too small for
/// larger numbers.
constexpr std::uint64_t kMostRows = 1'000'000'000;

/// Writes or reads the arrays that have one entry for each shape.
template <int Dim, class Archive, class Shapes>
void describe_shapes(Archive& archive, Shapes& shapes) {
  using enum Quantity;
  const auto rows = [&](const Field& field, auto get) { archive.rows(field, shapes, get); };
  rows(
      {"shapes/rounding", length, "radius of the ball that is added to the core"},
      [](auto& s) -> auto& { return s.rounding; });
  rows(
      {"shapes/volume", Dim == 2 ? ratio : volume, Dim == 2 ? "area of the shape (length^2)" : ""},
      [](auto& s) -> auto& { return s.volume; });
  rows(
      {"shapes/inertia", ratio, "principal moments of inertia for density 1 (length^(dimension + 2))"},
      [](auto& s) -> auto& { return s.inertia; });
  rows(
      {"shapes/outer_radius", length,
       "radius of the circumscribed sphere (circle in 2D) about the centre of mass"},
      [](auto& s) -> auto& { return s.outer_radius; });
  rows(
      {"shapes/inner_radius", length,
       "radius of the largest sphere (circle in 2D) about the centre of mass inside the core, plus rounding"},
      [](auto& s) -> auto& { return s.inner_radius; });
  rows(
      {"shapes/centre", length, "centre of mass in the coordinates from which the shape was made"},
      [](auto& s) -> auto& { return s.centre; });
}

template <int Dim, class Archive, class Grains>
void describe_shaped_grains(Archive& archive, Grains& grains) {
  archive.column({"grains/shape", Quantity::count, "index of the shape of the grain in shapes/"}, grains.shape);
  archive.column({"grains/scale", Quantity::ratio,
                  "factor by which the shape is magnified; radius = scale * "
                  "shapes/outer_radius"},
                 grains.scale);
}

constexpr Field kPoint = {"contacts/point", Quantity::length,
                          "vector from the centre of id1 to the contact point"};
constexpr Field kType = {
    "contacts/type", Quantity::count,
    "features that meet: 0 vertex and face, 1 edge and edge, 2 double (an edge on a face), "
    "3 face and face"};
constexpr std::int32_t kLastType = static_cast<std::int32_t>(ContactType::kFaceFace);

[[noreturn]] void refuse(const Hdf5Reader& file, const std::string& path, const std::string& what) {
  throw InputError(file.place(path), what);
}

/// Reads an array of row numbers, which refer to the rows of a second array. The second array contains the parts of all
/// items, item after item, one part per row. Entry k of the row numbers is the row of the first part of item k.
/// @return the row numbers, which ascend from 0 to the number of rows of the second array; their number is the number
/// of items plus 1
std::vector<std::int32_t> take_starts(const Hdf5Reader& file, ReadingArchive& archive, const Field& field,
                                      std::uint64_t n_items, std::uint64_t n_parts) {
  auto starts = archive.take<std::int32_t>(field, {n_items + 1});
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const std::int64_t least = k == 0 ? 0 : starts[k - 1];
    const bool last = k + 1 == starts.size();
    const auto most = static_cast<std::int64_t>(n_parts);
    if (starts[k] < least || starts[k] > most || (k == 0 && starts[k] != 0) || (last && starts[k] != most))
      refuse(file, field.path,
             fmt::format("entry {} is {}, expected numbers that ascend from 0 to {}", k, starts[k], most));
  }
  return starts;
}

std::uint64_t counted(const Hdf5Reader& file, const Field& field) {
  const std::uint64_t n = file.n_rows(field.path);
  if (n > kMostRows)
    refuse(file, field.path, fmt::format("the dataset has {} rows, expected at most {}", n, kMostRows));
  return n;
}

template <int Dim>
std::vector<Vec<Dim>> take_vectors(ReadingArchive& archive, const Field& field, std::uint64_t n) {
  std::vector<Vec<Dim>> vectors(n);
  archive.column(field, vectors);
  return vectors;
}

/// Reads the vertices and faces of all shapes.
template <int Dim>
void read_polytopes(const Hdf5Reader& file, ReadingArchive& archive, std::vector<Shape<Dim>>& shapes) {
  const std::uint64_t n_vertices = counted(file, kVertices), n_faces = counted(file, kOffsets),
                      n_corners = counted(file, kFaces);
  const auto vertices = take_vectors<Dim>(archive, kVertices, n_vertices);
  const auto normals = take_vectors<Dim>(archive, kNormals, n_faces);
  const auto offsets = archive.take<double>(kOffsets, {n_faces});
  const auto corners = archive.take<std::int32_t>(kFaces, {n_corners});
  const auto first_vertex = take_starts(file, archive, kFirstVertex, shapes.size(), n_vertices);
  const auto first_face = take_starts(file, archive, kFirstFace, shapes.size(), n_faces);
  const auto first_corner = take_starts(file, archive, kFirstCorner, n_faces, n_corners);
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    Shape<Dim>& shape = shapes[s];
    const std::int32_t face = first_face[s], face_end = first_face[s + 1];
    const std::int32_t corner = first_corner[face], corner_end = first_corner[face_end];
    shape.vertices.assign(vertices.begin() + first_vertex[s], vertices.begin() + first_vertex[s + 1]);
    shape.normals.assign(normals.begin() + face, normals.begin() + face_end);
    shape.offsets.assign(offsets.begin() + face, offsets.begin() + face_end);
    shape.corners.assign(corners.begin() + corner, corners.begin() + corner_end);
    for (std::int32_t f = face; f <= face_end; ++f) shape.first_corner.push_back(first_corner[f] - corner);
  }
}

template <int Dim>
void read_axes(ReadingArchive& archive, std::vector<Shape<Dim>>& shapes) {
  const auto values = archive.take<double>(kAxes, {shapes.size(), Dim * Dim});
  std::size_t next = 0;
  for (Shape<Dim>& shape : shapes)
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) shape.axes(a, b) = values[next++];
}

template <int Dim>
void check_shape(const Hdf5Reader& file, std::size_t index, Shape<Dim>& shape) {
  const auto require = [&](const std::optional<ShapeFault>& fault) {
    if (fault)
      refuse(file, std::string("shapes/") + fault->member, fmt::format("shape {}: {}", index, fault->words));
  };
  require(fault_of_faces(shape));
  set_adjacency(shape);
  require(fault_of_geometry(shape));
}

template <int Dim>
void check_shaped_grains(const Hdf5Reader& file, const Grains<Dim>& grains) {
  const auto n = static_cast<int>(grains.shapes->size());
  for (int i = 0; i < grains.size(); ++i) {
    if (grains.shape[i] < 0 || grains.shape[i] >= n)
      refuse(file, "grains/shape",
             fmt::format("entry {} is {}, expected a shape from 0 to {}", i, grains.shape[i], n - 1));
    if (!(grains.scale[i] > 0.0))
      refuse(file, "grains/scale",
             fmt::format("entry {} is {}, expected a positive number", i, grains.scale[i]));
    const double expected = grains.scale[i] * (*grains.shapes)[grains.shape[i]].outer_radius;
    if (!(std::abs(grains.radius[i] - expected) <= kRadiusError * expected))
      refuse(
          file, "grains/radius",
          fmt::format("entry {} is {:.17g}, expected {:.17g}: the scale of the grain times the outer radius of "
                      "its shape",
                      i, grains.radius[i], expected));
  }
}

}  // namespace

template <int Dim>
void write_shapes(WritingArchive& archive, const Packing<Dim>& packing) {
  // If a file lacks the group `shapes`, read_shapes_of_state() takes the grains as round.
  if (packing.grains.are_round()) return;
  const std::vector<Shape<Dim>>& shapes = *packing.grains.shapes;
  // Shapes differ in their numbers of vertices and faces, but all rows of an array have the same length. Therefore the
  // vertices of all shapes form one array, and so do the faces. The arrays first_... contain the row at which the part
  // of each shape or face begins; their last entry is the number of rows.
  std::vector<std::int32_t> first_vertex = {0}, first_face = {0}, first_corner = {0}, faces;
  std::vector<Vec<Dim>> vertices, normals;
  std::vector<double> offsets, axes;
  for (const Shape<Dim>& shape : shapes) {
    vertices.insert(vertices.end(), shape.vertices.begin(), shape.vertices.end());
    normals.insert(normals.end(), shape.normals.begin(), shape.normals.end());
    offsets.insert(offsets.end(), shape.offsets.begin(), shape.offsets.end());
    for (int f = 0; f < shape.n_faces(); ++f) {
      faces.insert(faces.end(), shape.loop(f).begin(), shape.loop(f).end());
      first_corner.push_back(static_cast<std::int32_t>(faces.size()));
    }
    first_vertex.push_back(static_cast<std::int32_t>(vertices.size()));
    first_face.push_back(static_cast<std::int32_t>(normals.size()));
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) axes.push_back(shape.axes(a, b));
  }
  archive.put(kFirstVertex, {first_vertex.size()}, first_vertex);
  archive.column(kVertices, vertices);
  archive.put(kFirstFace, {first_face.size()}, first_face);
  archive.put(kFirstCorner, {first_corner.size()}, first_corner);
  archive.put(kFaces, {faces.size()}, faces);
  archive.column(kNormals, normals);
  archive.put(kOffsets, {offsets.size()}, offsets);
  describe_shapes<Dim>(archive, shapes);
  archive.put(kAxes, {shapes.size(), Dim * Dim}, axes);
  describe_shaped_grains<Dim>(archive, packing.grains);
  std::vector<std::int32_t> types;
  for (const Contact<Dim>& c : packing.contacts) types.push_back(static_cast<std::int32_t>(c.type));
  // Only the lever arm of the first grain is stored. A reader subtracts the branch vector from it to obtain the lever
  // arm of the second grain.
  archive.rows(
      kPoint, packing.contacts, [](auto& c) -> auto& { return c.arm_i; });
  archive.put(kType, {types.size()}, types);
}

template <int Dim>
void read_shapes_of_state(const Hdf5Reader& file, ReadingArchive& archive, Grains<Dim>& grains) {
  if (!file.has("shapes")) return;
  const std::uint64_t n = file.n_rows("shapes/rounding");
  if (n < 1 || n > kMostRows)
    refuse(file, "shapes/rounding", fmt::format("the dataset has {} rows, expected 1 to {}", n, kMostRows));
  std::vector<Shape<Dim>> shapes(n);
  describe_shapes<Dim>(archive, shapes);
  read_axes<Dim>(archive, shapes);
  read_polytopes<Dim>(file, archive, shapes);
  for (std::size_t s = 0; s < shapes.size(); ++s) check_shape(file, s, shapes[s]);
  grains.shapes = std::make_shared<const std::vector<Shape<Dim>>>(std::move(shapes));
  grains.shape.resize(grains.radius.size());
  grains.scale.resize(grains.radius.size());
  describe_shaped_grains<Dim>(archive, grains);
  check_shaped_grains(file, grains);
}

template <int Dim>
void read_contact_points(const Hdf5Reader& file, ReadingArchive& archive, Packing<Dim>& packing) {
  archive.rows(
      kPoint, packing.contacts, [](auto& c) -> auto& { return c.arm_i; });
  const auto types = archive.take<std::int32_t>(kType, {packing.contacts.size()});
  for (std::size_t k = 0; k < types.size(); ++k) {
    Contact<Dim>& c = packing.contacts[k];
    if (types[k] < 0 || types[k] > kLastType)
      refuse(file, kType.path,
             fmt::format("entry {} is {}, expected a type from 0 to {}", k, types[k], kLastType));
    c.type = static_cast<ContactType>(types[k]);
    c.arm_j = c.arm_i - branch(packing, c);
    if (k > 0 && !precedes(packing.contacts[k - 1], c))
      refuse(file, "contacts/key",
             fmt::format("entry {} is {}: expected contacts in ascending order of id1, id2, image and key", k,
                         c.key));
  }
}

#define FLOC_INSTANTIATE(Dim)                                                           \
  template void write_shapes(WritingArchive&, const Packing<Dim>&);                     \
  template void read_shapes_of_state(const Hdf5Reader&, ReadingArchive&, Grains<Dim>&); \
  template void read_contact_points(const Hdf5Reader&, ReadingArchive&, Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
