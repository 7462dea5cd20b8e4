#include "floc/shape/shape_fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "floc/shape/moments.h"

namespace floc {
namespace {

/// Largest accepted relative error of recorded properties.
constexpr double kRelative = 1e-9;
/// Largest accepted height of a vertex above a face, relative to the size of the shape. A face may consist of merged
/// faces whose normals differ by less than 1e-6 radians, so the distances of its vertices from its plane may be up to
/// about 1e-6 of its size.
constexpr double kFlat = 1e-5;

bool differs(double found, double expected, double size) {
  return !(std::abs(found - expected) <= kRelative * size);
}

template <int Dim>
double size_of(const Shape<Dim>& shape) {
  double largest = 0.0;
  for (const Vec<Dim>& v : shape.vertices) largest = std::max(largest, v.norm());
  return largest;
}

/// Returns a fault if no valid shape can have the numbers of vertices and faces of `shape`.
template <int Dim>
std::optional<ShapeFault> fault_of_counts(const Shape<Dim>& shape) {
  const int n = shape.n_vertices();
  if (n > kMostVertices)
    return ShapeFault{"vertices", fmt::format("it has {} vertices, expected at most {}", n, kMostVertices)};
  if (shape.n_faces() > kMostFaces || static_cast<int>(shape.corners.size()) > 2 * kMostFaces)
    return ShapeFault{"faces",
                      fmt::format("it has {} faces with {} corners, expected at most {} faces and {} edges",
                                  shape.n_faces(), shape.corners.size(), kMostFaces, kMostFaces)};
  const int least_faces = n == 0 ? 0 : n == 2 ? (Dim == 2 ? 2 : 0) : Dim + 1;
  if (n == 1 || (Dim == 3 && n == 3) ||
      (n > 2 ? shape.n_faces() < least_faces : shape.n_faces() != least_faces))
    return ShapeFault{"faces",
                      fmt::format("it has {} vertices and {} faces: expected the faces of a polytope, the "
                                  "two ends of a capsule, or no vertex (a {})",
                                  n, shape.n_faces(), Dim == 2 ? "disk" : "sphere")};
  return std::nullopt;
}

RotationVector<2> inertia_about_axes(const Mat<2>& second) {
  return RotationVector<2>(second.trace());
}
RotationVector<3> inertia_about_axes(const Mat<3>& second) {
  return second.trace() * Vec<3>::Ones() - second.diagonal();
}

/// Returns a fault if the recorded volume or moments of inertia differ from those computed from the shape.
template <int Dim>
std::optional<ShapeFault> fault_of_mass(const Shape<Dim>& shape, double volume,
                                        const RotationVector<Dim>& inertia) {
  if (!(volume > 0.0) || differs(shape.volume, volume, volume))
    return ShapeFault{"volume", fmt::format("it is recorded as {:.12g}, but the volume of the shape is {:.12g}",
                                            shape.volume, volume)};
  for (int a = 0; a < inertia.size(); ++a)
    if (differs(shape.inertia[a], inertia[a], inertia.maxCoeff()))
      return ShapeFault{
          "inertia", fmt::format("component {} is recorded as {:.12g}, but the moment of the shape is {:.12g}",
                                 a, shape.inertia[a], inertia[a])};
  return std::nullopt;
}

/// Returns a fault if the recorded mass properties of a polytope (in 2D also of a capsule) are wrong.
template <int Dim>
std::optional<ShapeFault> fault_of_moments(const Shape<Dim>& shape, const Polytope<Dim>& core) {
  const Moments<Dim> moments = body_moments(core, shape.rounding);
  const double length = size_of(shape) + shape.rounding;
  if (!(moments.first.norm() <= kRelative * moments.volume * length))
    return ShapeFault{"vertices", "the origin of the vertices is not the centre of mass of the shape"};
  if constexpr (Dim == 3) {
    const Mat<3> off = moments.second - Mat<3>(moments.second.diagonal().asDiagonal());
    if (!(off.norm() <= kRelative * moments.volume * length * length))
      return ShapeFault{"vertices", "the axes of the vertices are not the principal axes of the shape"};
  }
  return fault_of_mass<Dim>(shape, moments.volume, inertia_about_axes(moments.second));
}

template <int Dim>
std::optional<ShapeFault> fault_of_mass_properties(const Shape<Dim>& shape, const Polytope<Dim>& core) {
  if (shape.n_faces() > 0) return fault_of_moments(shape, core);
  const Shape<Dim> expected = shape.is_round() ? round_shape<Dim>(shape.rounding)
                                               : capsule_shape<Dim>(2.0 * size_of(shape), shape.rounding);
  return fault_of_mass<Dim>(shape, expected.volume, expected.inertia);
}

template <int Dim>
std::optional<ShapeFault> fault_of_radii(const Shape<Dim>& shape) {
  const double outer = size_of(shape) + shape.rounding;
  const double inner =
      std::max(0.0, shape.offsets.empty() ? 0.0 : *std::ranges::min_element(shape.offsets)) + shape.rounding;
  if (differs(shape.outer_radius, outer, outer))
    return ShapeFault{"outer_radius",
                      fmt::format("it is recorded as {:.12g}, but the outer radius of the shape is {:.12g}",
                                  shape.outer_radius, outer)};
  if (differs(shape.inner_radius, inner, outer))
    return ShapeFault{"inner_radius",
                      fmt::format("it is recorded as {:.12g}, but the inner radius of the shape is {:.12g}",
                                  shape.inner_radius, inner)};
  return std::nullopt;
}

}  // namespace

template <int Dim>
std::optional<ShapeFault> fault_of_faces(const Shape<Dim>& shape) {
  if (auto fault = fault_of_counts(shape)) return fault;
  // 3D: edges of the faces, with direction. 2D: numbers of sides that begin and end at each vertex; both have to be 1.
  std::set<std::pair<int, int>> directed;
  std::vector<int> begins(shape.vertices.size(), 0), ends(shape.vertices.size(), 0);
  for (int f = 0; f < shape.n_faces(); ++f) {
    const std::span<const int> loop = shape.loop(f);
    const auto fault = [&](const std::string& words) {
      return ShapeFault{"faces", fmt::format("face {}: {}", f, words)};
    };
    if (Dim == 2 ? loop.size() != 2 : loop.size() < 3)
      return fault(fmt::format("it has {} vertices, expected {}", loop.size(), Dim == 2 ? "2" : "3 or more"));
    for (const int v : loop)
      if (v < 0 || v >= shape.n_vertices())
        return fault(
            fmt::format("it has the vertex {}: expected vertices from 0 to {}", v, shape.n_vertices() - 1));
    if (std::set<int>(loop.begin(), loop.end()).size() != loop.size()) return fault("it has a vertex twice");
    for (std::size_t k = 0; k < (Dim == 2 ? 1 : loop.size()); ++k) {
      const int from = loop[k], to = loop[(k + 1) % loop.size()];
      if (!directed.insert({from, to}).second)
        return fault(
            fmt::format("another face also has the edge from vertex {} to {} in this direction", from, to));
      ++begins[from], ++ends[to];
    }
    if (Dim == 2 && loop[1] != shape.loop((f + 1) % shape.n_faces())[0])
      return fault("the next side does not begin at the end of this side");
  }
  for (const auto& [from, to] : directed)
    if (Dim == 3 && !directed.contains({to, from}))
      return ShapeFault{"faces",
                        fmt::format("only one face has the edge between the vertices {} and {}", from, to)};
  if (shape.n_faces() > 0)
    for (int v = 0; v < shape.n_vertices(); ++v)
      if (Dim == 2 ? begins[v] != 1 || ends[v] != 1 : begins[v] < 3)
        return ShapeFault{"faces", fmt::format("{1} edges begin at vertex {0}, expected {2}", v, begins[v],
                                               Dim == 2 ? "1" : "3 or more")};
  // Euler's formula does not hold for surfaces that have several parts or handles.
  const int n_edges = static_cast<int>(directed.size()) / 2;
  if (Dim == 3 && shape.n_faces() > 0 && shape.n_vertices() - n_edges + shape.n_faces() != 2)
    return ShapeFault{"faces", "the faces do not form one closed surface"};
  return std::nullopt;
}

template <int Dim>
std::optional<ShapeFault> fault_of_geometry(const Shape<Dim>& shape) {
  const double size = size_of(shape);
  if (!(shape.rounding >= 0.0) || (shape.n_faces() == 0 && !(shape.rounding > 0.0)))
    return ShapeFault{"rounding", fmt::format("it is {}, expected a positive radius{}", shape.rounding,
                                              shape.n_faces() == 0 ? "" : ", or 0")};
  if (shape.n_vertices() == 2 && (shape.vertices[0] + shape.vertices[1]).norm() > kRelative * size)
    return ShapeFault{"vertices", "the two ends of a capsule are not opposite to each other"};
  if (shape.n_vertices() == 2 && !(std::abs(shape.vertices[1][0]) >= (1.0 - kRelative) * size))
    return ShapeFault{"vertices", "the two ends of a capsule are not on the first axis"};
  const Polytope<Dim> core = core_of(shape);
  for (int f = 0; f < shape.n_faces(); ++f) {
    const Vec<Dim> normal = face_normal(core, f).normalized();
    // The comparison is negated, so that a normal with a NaN is a fault, too.
    if (!((shape.normals[f] - normal).norm() <= kRelative))
      return ShapeFault{"normals", fmt::format("the normal of face {} is not normal to the face", f)};
    // A shape is convex if none of its vertices lies above the plane of any face. The offset of a face is the height of
    // its highest vertex, because the vertices of merged faces do not lie exactly in one plane.
    double highest = -size;
    for (const int v : shape.loop(f)) highest = std::max(highest, shape.normals[f].dot(shape.vertices[v]));
    if (differs(shape.offsets[f], highest, size))
      return ShapeFault{"offsets",
                        fmt::format("the offset of face {} is recorded as {:.12g}, but it is {:.12g}", f,
                                    shape.offsets[f], highest)};
    for (int v = 0; v < shape.n_vertices(); ++v)
      if (!(shape.normals[f].dot(shape.vertices[v]) <= highest + kFlat * size))
        return ShapeFault{"vertices",
                          fmt::format("the shape is not convex: vertex {} lies outside face {}", v, f)};
  }
  // The formulas for the mass of a rounded shape hold only for a convex core, so the convexity is tested before the
  // mass.
  if (auto fault = fault_of_mass_properties(shape, core)) return fault;
  return fault_of_radii(shape);
}

#define FLOC_INSTANTIATE(Dim)                                           \
  template std::optional<ShapeFault> fault_of_faces(const Shape<Dim>&); \
  template std::optional<ShapeFault> fault_of_geometry(const Shape<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
