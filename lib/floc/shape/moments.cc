#include "floc/shape/moments.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "floc/shape/cross_product.h"

namespace floc {
namespace {

template <int Dim>
Mat<Dim> symmetric_product(const Vec<Dim>& a, const Vec<Dim>& b) {
  return a * b.transpose() + b * a.transpose();
}

/// Arc of unit vectors w = cos(phi) a + sin(phi) t, which begins in the direction a; the unit vector t is normal to a.
/// The members are the integrals of w and of w w' over the angle phi (w' is the transpose of w).
template <int Dim>
struct Arc {
  double angle;
  Vec<Dim> first;
  Mat<Dim> second;

  Arc(const Vec<Dim>& a, const Vec<Dim>& t, double theta) : angle(theta) {
    const double sine = std::sin(theta), cosine = std::cos(theta);
    first = sine * a + (1.0 - cosine) * t;
    second = 0.5 * (theta + sine * cosine) * a * a.transpose() +
             0.5 * (theta - sine * cosine) * t * t.transpose() +
             0.5 * sine * sine * symmetric_product<Dim>(a, t);
  }
};

/// Returns the arc between the outward normals `left` and `right` of two faces that share an edge. The unit vector `axis`
/// is parallel to the edge. For a viewer outside the body who looks along `axis`, the face with the normal `left` is on
/// the left.
Arc<3> arc_of_edge(const Vec<3>& left, const Vec<3>& right, const Vec<3>& axis) {
  return {left, axis.cross(left), std::atan2(axis.dot(left.cross(right)), left.dot(right))};
}

Moments<2> side_layer(const Vec<2>& a, const Vec<2>& b, const Vec<2>& n, double rho) {
  // Rounding by the radius rho adds a rectangle on each side. With the length l of the side, the second moments of the
  // rectangle about its centre, divided by its area, are l^2/12 along the side and rho^2/12 across the side.
  const Vec<2> side = b - a, middle = 0.5 * (a + b + rho * n);
  const double area = side.norm() * rho;
  return {area, area * middle,
          area * (middle * middle.transpose() + side * side.transpose() / 12.0 +
                  rho * rho / 12.0 * n * n.transpose())};
}

Moments<2> corner_layer(const Vec<2>& v, const Vec<2>& from, const Vec<2>& to, double rho) {
  double angle = std::atan2(cross_product(from, to), from.dot(to));
  if (angle < 0.0) angle += 2.0 * std::numbers::pi;
  const Arc<2> arc(from, Vec<2>(-from[1], from[0]), angle);
  const double area = 0.5 * rho * rho * angle, rho3 = rho * rho * rho;
  return {area, area * v + rho3 / 3.0 * arc.first,
          area * v * v.transpose() + rho3 / 3.0 * symmetric_product<2>(v, arc.first) +
              0.25 * rho3 * rho * arc.second};
}

/// Returns the moments of a face of a polyhedron: integrals over the area of the face.
Moments<3> surface_moments(const Polytope<3>& polytope, const std::vector<int>& loop, const Vec<3>& n) {
  Moments<3> sum;
  const Vec<3>& a = polytope.vertices[loop[0]];
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const Vec<3>&b = polytope.vertices[loop[k]], &c = polytope.vertices[loop[k + 1]];
    const double area = 0.5 * n.dot((b - a).cross(c - a));
    const Vec<3> s = a + b + c;
    sum += {area, area / 3.0 * s,
            area / 12.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose())};
  }
  return sum;
}

Moments<3> face_layer(const Moments<3>& face, const Vec<3>& n, double rho) {
  const double rho2 = rho * rho;
  return {rho * face.volume, rho * face.first + 0.5 * rho2 * face.volume * n,
          rho * face.second + 0.5 * rho2 * symmetric_product<3>(face.first, n) +
              rho2 * rho / 3.0 * face.volume * n * n.transpose()};
}

Moments<3> edge_layer(const Vec<3>& from, const Vec<3>& to, const Arc<3>& arc, double rho) {
  const Vec<3> edge = to - from, middle = 0.5 * (from + to);
  const double length = edge.norm(), area = 0.5 * rho * rho * arc.angle, rho3 = rho * rho * rho;
  return {length * area, length * (area * middle + rho3 / 3.0 * arc.first),
          length * (area * middle * middle.transpose() + area / 12.0 * edge * edge.transpose() +
                    rho3 / 3.0 * symmetric_product<3>(middle, arc.first) + 0.25 * rho3 * rho * arc.second)};
}

/// Integrals of 1, u and u u' (u' is the transpose of u) over all unit vectors u in the cone between the normals of the
/// faces at one vertex.
using NormalCone = Moments<3>;

/// Adds the contribution of one side of a normal cone to the integrals of the cone. The side is the arc between the
/// normals of the two faces at an edge. The unit vector `outward` is the direction of the edge away from the vertex; it
/// is normal to the arc and points out of the cone.
///
/// Let I be the identity matrix and W the solid angle of the cone. For each side, let t be its angle, n its outward
/// normal, and m the integral of u along the arc. With sums over the sides, the integral of u is -(1/2) sum t n, and
/// the integral of u u' is (W I - sum n m')/3 (Arvo 1995).
void add_arc(NormalCone& cone, const Vec<3>& outward, const Arc<3>& arc) {
  cone.first -= 0.5 * arc.angle * outward;
  cone.second -= symmetric_product<3>(outward, arc.first) / 6.0;
}

/// Returns the solid angle of the spherical triangle between three unit vectors (Van Oosterom and Strackee 1983).
double solid_angle(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
  return 2.0 * std::atan2(std::abs(a.dot(b.cross(c))), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

Moments<3> vertex_layer(const Vec<3>& v, const NormalCone& cone, double rho) {
  const double rho3 = rho * rho * rho, volume = cone.volume * rho3 / 3.0;
  const Vec<3> first = 0.25 * rho3 * rho * cone.first;
  const Mat<3> second = 0.2 * rho3 * rho * rho * (cone.volume / 3.0 * Mat<3>::Identity() + cone.second);
  return {volume, volume * v + first, volume * v * v.transpose() + symmetric_product<3>(v, first) + second};
}

}  // namespace

template <int Dim>
Moments<Dim>& Moments<Dim>::operator+=(const Moments& other) {
  volume += other.volume;
  first += other.first;
  second += other.second;
  return *this;
}

Vec<2> face_normal(const Polytope<2>& polytope, int face) {
  const std::vector<int>& loop = polytope.faces[face];
  const Vec<2> side = polytope.vertices[loop[1]] - polytope.vertices[loop[0]];
  return {side[1], -side[0]};
}

Vec<3> face_normal(const Polytope<3>& polytope, int face) {
  const std::vector<int>& loop = polytope.faces[face];
  const Vec<3>& origin = polytope.vertices[loop[0]];
  Vec<3> sum = Vec<3>::Zero();
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    sum += (polytope.vertices[loop[k]] - origin).cross(polytope.vertices[loop[k + 1]] - origin);
  return sum;
}

template <>
Moments<2> sharp_moments(const Polytope<2>& polytope) {
  Moments<2> sum;
  for (const std::vector<int>& side : polytope.faces) {
    const Vec<2>&a = polytope.vertices[side[0]], &b = polytope.vertices[side[1]];
    const double x = cross_product(a, b);
    const Vec<2> s = a + b;
    sum += {0.5 * x, x / 6.0 * s, x / 24.0 * (a * a.transpose() + b * b.transpose() + s * s.transpose())};
  }
  return sum;
}

template <>
Moments<3> sharp_moments(const Polytope<3>& polytope) {
  Moments<3> sum;
  for (const std::vector<int>& loop : polytope.faces) {
    const Vec<3>& a = polytope.vertices[loop[0]];
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      const Vec<3>&b = polytope.vertices[loop[k]], &c = polytope.vertices[loop[k + 1]];
      const double x = a.dot(b.cross(c));
      const Vec<3> s = a + b + c;
      sum += {x / 6.0, x / 24.0 * s,
              x / 120.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose())};
    }
  }
  return sum;
}

template <>
Moments<2> rounding_moments(const Polytope<2>& polytope, double rounding) {
  Moments<2> sum;
  const std::size_t n = polytope.faces.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::vector<int>& side = polytope.faces[k];
    const Vec<2> normal = face_normal(polytope, static_cast<int>(k)).normalized();
    const Vec<2> next = face_normal(polytope, static_cast<int>((k + 1) % n)).normalized();
    sum += side_layer(polytope.vertices[side[0]], polytope.vertices[side[1]], normal, rounding);
    sum += corner_layer(polytope.vertices[side[1]], normal, next, rounding);
  }
  return sum;
}

template <>
Moments<3> rounding_moments(const Polytope<3>& polytope, double rounding) {
  Moments<3> sum;
  std::vector<Vec<3>> normals;
  std::map<std::pair<int, int>, int> face_left_of;
  for (std::size_t f = 0; f < polytope.faces.size(); ++f) {
    const std::vector<int>& loop = polytope.faces[f];
    normals.push_back(face_normal(polytope, static_cast<int>(f)).normalized());
    sum += face_layer(surface_moments(polytope, loop, normals[f]), normals[f], rounding);
    for (std::size_t k = 0; k < loop.size(); ++k)
      face_left_of[{loop[k], loop[(k + 1) % loop.size()]}] = static_cast<int>(f);
  }
  // The normals of the faces at a vertex are the corners of a convex polygon on the unit sphere. The sides of the
  // polygon are the arcs of the edges at the vertex. The solid angle of the polygon is a sum over triangles: each
  // triangle has one arc as a side and one fixed normal as the opposite corner.
  std::vector<NormalCone> cones(polytope.vertices.size());
  std::vector<int> any_face(polytope.vertices.size(), -1);
  for (const auto& [ends, left] : face_left_of) {
    const auto [from, to] = ends;
    const int right = face_left_of.at({to, from});
    const Vec<3> axis = (polytope.vertices[to] - polytope.vertices[from]).normalized();
    const Arc<3> arc = arc_of_edge(normals[left], normals[right], axis);
    add_arc(cones[from], axis, arc);
    if (any_face[from] < 0) any_face[from] = left;
    cones[from].volume += solid_angle(normals[any_face[from]], normals[left], normals[right]);
    if (from < to) sum += edge_layer(polytope.vertices[from], polytope.vertices[to], arc, rounding);
  }
  for (std::size_t v = 0; v < cones.size(); ++v) sum += vertex_layer(polytope.vertices[v], cones[v], rounding);
  return sum;
}

template struct Moments<2>;
template struct Moments<3>;

}  // namespace floc
