#include "floc/shape/shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "floc/base/error.h"
#include "floc/shape/moments.h"
#include "floc/shape/principal_axes.h"
#include "floc/shape/shape_adjacency.h"

namespace floc {
namespace {

/// Largest allowed ratio of the extents of a shape along its principal axes.
constexpr double kLargestAspect = 20.0;
/// Smallest allowed volume of the core of a shape (the shape without rounding), divided by the volume of the bounding
/// box of the core.
constexpr double kLeastFilling = 1e-6;
/// Largest allowed height of a vertex above the plane of a face, divided by the distance from the centre to the
/// furthest vertex. Merged faces cause heights of up to 1e-6.
constexpr double kConvexTolerance = 1e-5;

double power(double x, int n) {
  return n == 0 ? 1.0 : x * power(x, n - 1);
}

RotationVector<2> inertia_of(const Mat<2>& second) {
  return RotationVector<2>(second.trace());
}
RotationVector<3> inertia_of(const Mat<3>& second) {
  return RotationVector<3>(second(1, 1) + second(2, 2), second(0, 0) + second(2, 2),
                           second(0, 0) + second(1, 1));
}

template <int Dim>
void set_faces(const Polytope<Dim>& polytope, Shape<Dim>& shape) {
  shape.first_corner = {0};
  for (std::size_t f = 0; f < polytope.faces.size(); ++f) {
    const std::vector<int>& loop = polytope.faces[f];
    const Vec<Dim> n = face_normal(polytope, static_cast<int>(f)).normalized();
    // The distances of the vertices of a merged face from their mean plane may be up to about 1e-6 of the size of the
    // face. The plane of the face goes through the highest of these vertices, so no vertex of the face lies above the
    // plane.
    double offset = -std::numeric_limits<double>::max();
    for (const int v : loop) offset = std::max(offset, n.dot(polytope.vertices[v]));
    shape.normals.push_back(n);
    shape.offsets.push_back(offset);
    shape.corners.insert(shape.corners.end(), loop.begin(), loop.end());
    shape.first_corner.push_back(static_cast<int>(shape.corners.size()));
  }
}

/// Requires that no vertex lies above a face. The faces may be wrong if all points lie nearly in one plane.
template <int Dim>
void require_convex(const Shape<Dim>& shape, const std::string& place) {
  double size = 0.0;
  for (const Vec<Dim>& v : shape.vertices) size = std::max(size, v.norm());
  for (int f = 0; f < shape.n_faces(); ++f)
    for (const Vec<Dim>& v : shape.vertices)
      if (shape.normals[f].dot(v) - shape.offsets[f] > kConvexTolerance * size)
        throw InputError(place,
                         "the convex hull cannot be determined, because the points are too close to one plane: "
                         "expected a polyhedron");
}

template <int Dim>
void set_radii(Shape<Dim>& shape) {
  double outer = 0.0;
  for (const Vec<Dim>& v : shape.vertices) outer = std::max(outer, v.norm());
  double inner = shape.offsets.empty() ? 0.0 : *std::min_element(shape.offsets.begin(), shape.offsets.end());
  shape.outer_radius = outer + shape.rounding;
  shape.inner_radius = std::max(inner, 0.0) + shape.rounding;
}

template <int Dim>
void require_counts(const Polytope<Dim>& hull, const std::string& place) {
  const std::size_t n_vertices = hull.vertices.size(), n_faces = hull.faces.size();
  std::size_t n_edges = 0;
  for (const std::vector<int>& loop : hull.faces) n_edges += loop.size();
  n_edges = Dim == 3 ? n_edges / 2 : 0;
  if (n_vertices > kMostVertices)
    throw InputError(
        place,
        fmt::format("the convex hull has {} vertices: expected at most {}; `vertices = N` keeps N of them",
                    n_vertices, kMostVertices));
  for (const auto& [n, name] : {std::pair(n_faces, "faces"), std::pair(n_edges, "edges")})
    if (n > kMostFaces)
      throw InputError(place,
                       fmt::format("the convex hull has {} {}: expected at most {}", n, name, kMostFaces));
}

template <int Dim>
void require_body(const Polytope<Dim>& hull, const Shape<Dim>& shape, double core_volume,
                  const std::string& place) {
  const auto extents = [](const std::vector<Vec<Dim>>& vertices) {
    Vec<Dim> low = vertices[0], high = vertices[0];
    for (const Vec<Dim>& v : vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
    return Vec<Dim>(high - low);
  };
  const double box = extents(hull.vertices).prod();
  if (!(core_volume > kLeastFilling * box) || !(core_volume > 0.0))
    throw InputError(place, fmt::format("the shape is flat: its volume is {:.3g} of the volume of its bounding "
                                        "box, expected more than {:g}",
                                        core_volume / box, kLeastFilling));
  const Vec<Dim> own = extents(shape.vertices);
  if (own.maxCoeff() > kLargestAspect * own.minCoeff())
    throw InputError(place,
                     fmt::format("the shape is {:.3g} times as long as it is thick: expected at most {:g}",
                                 own.maxCoeff() / own.minCoeff(), kLargestAspect));
}

}  // namespace

template <int Dim>
void set_adjacency(Shape<Dim>& shape) {
  std::vector<std::vector<int>> meeting(shape.vertices.size());
  for (int f = 0; f < shape.n_faces(); ++f)
    for (const int v : shape.loop(f)) meeting[v].push_back(f);
  shape.first_of_vertex = {0};
  for (const std::vector<int>& faces : meeting) {
    shape.vertex_faces.insert(shape.vertex_faces.end(), faces.begin(), faces.end());
    shape.first_of_vertex.push_back(static_cast<int>(shape.vertex_faces.size()));
  }
  if constexpr (Dim == 3) {
    std::map<std::pair<int, int>, int> face_left_of;
    for (int f = 0; f < shape.n_faces(); ++f) {
      const std::span<const int> loop = shape.loop(f);
      for (std::size_t k = 0; k < loop.size(); ++k) face_left_of[{loop[k], loop[(k + 1) % loop.size()]}] = f;
    }
    for (const auto& [ends, left] : face_left_of)
      if (ends.first < ends.second)
        shape.edges.push_back({ends.first, ends.second, left, face_left_of.at({ends.second, ends.first})});
  }
}

template <int Dim>
double Shape<Dim>::equal_volume_diameter() const {
  return Dim == 2 ? std::sqrt(4.0 * volume / std::numbers::pi) : std::cbrt(6.0 * volume / std::numbers::pi);
}

template <int Dim>
Shape<Dim> round_shape(double radius) {
  Shape<Dim> shape;
  shape.rounding = shape.outer_radius = shape.inner_radius = radius;
  shape.volume =
      Dim == 2 ? std::numbers::pi * power(radius, 2) : 4.0 / 3.0 * std::numbers::pi * power(radius, 3);
  shape.inertia.setConstant((Dim == 2 ? 0.5 : 0.4) * shape.volume * radius * radius);
  shape.first_corner = shape.first_of_vertex = {0};
  return shape;
}

template <>
Shape<2> capsule_shape(double length, double rounding) {
  Polytope<2> core;
  core.vertices = {{-0.5 * length, 0.0}, {0.5 * length, 0.0}};
  core.faces = {{0, 1}, {1, 0}};
  Shape<2> shape;
  shape.vertices = core.vertices;
  shape.rounding = rounding;
  const Moments<2> moments = rounding_moments(core, rounding);
  shape.volume = moments.volume;
  shape.inertia = inertia_of(moments.second);
  set_faces(core, shape);
  set_adjacency(shape);
  set_radii(shape);
  return shape;
}

template <>
Shape<3> capsule_shape(double length, double rounding) {
  Shape<3> shape;
  shape.vertices = {{-0.5 * length, 0.0, 0.0}, {0.5 * length, 0.0, 0.0}};
  shape.rounding = rounding;
  const double r2 = rounding * rounding, rod = std::numbers::pi * r2 * length,
               ball = 4.0 / 3.0 * std::numbers::pi * r2 * rounding;
  shape.volume = rod + ball;
  const double across = rod * (length * length / 12.0 + 0.25 * r2) +
                        ball * (0.4 * r2 + 0.25 * length * length + 0.375 * length * rounding);
  shape.inertia = {0.5 * rod * r2 + 0.4 * ball * r2, across, across};
  shape.first_corner = {0};
  shape.first_of_vertex = {0, 0, 0};
  set_radii(shape);
  return shape;
}

template <int Dim>
Shape<Dim> capsule_between(const Vec<Dim>& from, const Vec<Dim>& to, double rounding,
                           const std::string& place) {
  const Vec<Dim> along = to - from;
  const double length = along.norm();
  if (!(length > 0.0)) throw InputError(place, "points 1 and 2 are equal: expected each vertex once");
  if (length > 38.0 * rounding)  // the capsule is more than 20 times as long as thick
    throw InputError(place,
                     fmt::format("the capsule is {:.3g} times as long as it is thick: expected at most 20",
                                 0.5 * length / rounding + 1.0));
  Shape<Dim> shape = capsule_shape<Dim>(length, rounding);
  shape.centre = 0.5 * (from + to);
  shape.axes.col(0) = along / length;
  if constexpr (Dim == 2) {
    shape.axes.col(1) = Vec<2>(-shape.axes(1, 0), shape.axes(0, 0));
  } else {
    shape.axes.col(1) = shape.axes.col(0).unitOrthogonal();
    shape.axes.col(2) = shape.axes.col(0).cross(shape.axes.col(1));
  }
  return shape;
}

template <int Dim>
Shape<Dim> polytope_shape(const Polytope<Dim>& hull, double rounding, const std::string& place) {
  require_counts(hull, place);
  // The origin is moved into the polytope, so that the moments keep all digits if the polytope is far from the origin.
  Vec<Dim> inside = Vec<Dim>::Zero();
  for (const Vec<Dim>& v : hull.vertices) inside += v / static_cast<double>(hull.vertices.size());
  Polytope<Dim> core = hull;
  for (Vec<Dim>& v : core.vertices) v -= inside;
  Moments<Dim> moments = sharp_moments(core);
  const double core_volume = moments.volume;
  if (rounding > 0.0) moments += rounding_moments(core, rounding);

  Shape<Dim> shape;
  shape.rounding = rounding;
  shape.volume = moments.volume;
  const Vec<Dim> middle = moments.volume > 0.0 ? Vec<Dim>(moments.first / moments.volume) : Vec<Dim>::Zero();
  const Mat<Dim> second = moments.second - moments.volume * middle * middle.transpose();
  if constexpr (Dim == 3) shape.axes = principal_axes(second);
  shape.inertia = inertia_of(Mat<Dim>(shape.axes.transpose() * second * shape.axes));
  shape.centre = inside + middle;
  for (Vec<Dim>& v : core.vertices) v = (shape.axes.transpose() * (v - middle)).eval();
  shape.vertices = core.vertices;
  require_body(hull, shape, core_volume, place);
  set_faces(core, shape);
  require_convex(shape, place);
  set_adjacency(shape);
  set_radii(shape);
  return shape;
}

template <int Dim>
void require_distinct(const std::vector<Vec<Dim>>& points, const std::string& place) {
  if (points.empty()) return;
  Vec<Dim> low = points[0], high = points[0];
  for (const Vec<Dim>& v : points) low = low.cwiseMin(v), high = high.cwiseMax(v);
  const double least = 1e-9 * (high - low).maxCoeff();
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return std::pair(points[i][0], i) < std::pair(points[j][0], j); });
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t l = k + 1; l < order.size() && points[order[l]][0] - points[order[k]][0] <= least; ++l)
      if ((points[order[l]] - points[order[k]]).norm() <= least)
        throw InputError(place,
                         fmt::format("points {} and {} are equal: expected each vertex once",
                                     std::min(order[k], order[l]) + 1, std::max(order[k], order[l]) + 1));
}

template <int Dim>
ShapeOfPoints<Dim> shape_of_points(const std::vector<Vec<Dim>>& points, double rounding,
                                   const std::string& place) {
  const ConvexHull<Dim> hull = convex_hull<Dim>(points, place);
  require_distinct<Dim>(points, place);
  ShapeOfPoints<Dim> made{polytope_shape<Dim>(hull.polytope, rounding, place), {}};
  const std::size_t n_left_out = points.size() - hull.points.size();
  if (n_left_out > 0)
    made.remarks.push_back(
        fmt::format("{} of {} points are not vertices of the convex hull, which is used as the shape",
                    n_left_out, points.size()));
  return made;
}

template <int Dim>
Polytope<Dim> core_of(const Shape<Dim>& shape) {
  Polytope<Dim> core{shape.vertices, {}};
  for (int f = 0; f < shape.n_faces(); ++f) core.faces.emplace_back(shape.loop(f).begin(), shape.loop(f).end());
  return core;
}

template <int Dim>
Shape<Dim> scaled(Shape<Dim> shape, double factor) {
  for (Vec<Dim>& v : shape.vertices) v *= factor;
  for (double& offset : shape.offsets) offset *= factor;
  for (double* length : {&shape.rounding, &shape.outer_radius, &shape.inner_radius}) *length *= factor;
  shape.volume *= power(factor, Dim);
  shape.inertia *= power(factor, Dim + 2);
  shape.centre *= factor;
  return shape;
}

template <int Dim>
Shape<Dim> with_rounding_share(const Polytope<Dim>& core, double share, const std::string& place) {
  if (!(share >= 0.0 && share <= 0.45))
    throw InputError(
        place, fmt::format("rounding = {:g}: expected a fraction of the diameter, from 0 to 0.45", share));
  Shape<Dim> shape = polytope_shape(core, 0.0, place);
  // The outer radius depends on the radius of rounding, because rounding moves the centre of mass a little. The radius
  // of rounding is therefore found by iteration. If the shape has a centre of symmetry, one pass is enough; otherwise
  // each pass gives two or three more digits.
  if (share > 0.0)
    for (int pass = 0; pass < 20; ++pass) {
      const double outer = shape.outer_radius - shape.rounding;
      const double rounding = outer * share / (0.5 - share);
      const bool done = std::abs(rounding - shape.rounding) <= 1e-15 * rounding;
      shape = polytope_shape(core, rounding, place);
      if (done) break;
    }
  return shape;
}

template <int Dim>
Shape<Dim> with_unit_diameter(const Polytope<Dim>& core, double share, const std::string& place) {
  const Shape<Dim> shape = with_rounding_share(core, share, place);
  return scaled(shape, 1.0 / shape.diameter());
}

template struct Shape<2>;
template struct Shape<3>;
template Shape<2> round_shape(double);
template Shape<3> round_shape(double);
template void set_adjacency(Shape<2>&);
template void set_adjacency(Shape<3>&);
template Shape<2> capsule_between(const Vec<2>&, const Vec<2>&, double, const std::string&);
template Shape<3> capsule_between(const Vec<3>&, const Vec<3>&, double, const std::string&);
template Shape<2> polytope_shape(const Polytope<2>&, double, const std::string&);
template Shape<3> polytope_shape(const Polytope<3>&, double, const std::string&);
template ShapeOfPoints<2> shape_of_points(const std::vector<Vec<2>>&, double, const std::string&);
template ShapeOfPoints<3> shape_of_points(const std::vector<Vec<3>>&, double, const std::string&);
template Polytope<2> core_of(const Shape<2>&);
template Polytope<3> core_of(const Shape<3>&);
template Shape<2> scaled(Shape<2>, double);
template Shape<3> scaled(Shape<3>, double);
template void require_distinct(const std::vector<Vec<2>>&, const std::string&);
template void require_distinct(const std::vector<Vec<3>>&, const std::string&);
template Shape<2> with_rounding_share(const Polytope<2>&, double, const std::string&);
template Shape<3> with_rounding_share(const Polytope<3>&, double, const std::string&);
template Shape<2> with_unit_diameter(const Polytope<2>&, double, const std::string&);
template Shape<3> with_unit_diameter(const Polytope<3>&, double, const std::string&);

}  // namespace floc
