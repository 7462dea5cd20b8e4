#include "floc/shape/closest_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace floc {
namespace {

/// Pair of vertices, one of each shape, and the vector between the two vertices. The vector is a point of the Minkowski
/// difference of the cores (the shapes without their rounding).
template <int Dim>
struct Corner {
  Vec<Dim> difference;  ///< vector on_second - on_first between the two vertices
  Vec<Dim> on_first, on_second;
  int first, second;  ///< indices of the two vertices
};

/// Simplex of up to Dim + 1 corners. The point of the simplex closest to the origin is the sum of the corners, each
/// multiplied by its weight.
template <int Dim>
struct Simplex {
  std::array<Corner<Dim>, 4> corner;
  std::array<double, 4> weight;
  int n = 0;

  Vec<Dim> closest() const {
    Vec<Dim> sum = weight[0] * corner[0].difference;
    for (int k = 1; k < n; ++k) sum += weight[k] * corner[k].difference;
    return sum;
  }
  /// Removes all corners that are not in a list. Each entry of the list is the index of a corner and the new weight of
  /// the corner; the indices ascend.
  void keep(std::initializer_list<std::pair<int, double>> kept) {
    int k = 0;
    for (const auto& [from, w] : kept) {
      if (from != k) corner[k] = corner[from];
      weight[k++] = w;
    }
    n = k;
  }
};

template <int Dim>
void reduce_segment(Simplex<Dim>& s) {
  const Vec<Dim>&a = s.corner[0].difference, &b = s.corner[1].difference;
  const Vec<Dim> ab = b - a;
  const double along = -a.dot(ab), length2 = ab.squaredNorm();
  if (along <= 0.0 || length2 == 0.0) return s.keep({{0, 1.0}});
  if (along >= length2) return s.keep({{1, 1.0}});
  s.keep({{0, 1.0 - along / length2}, {1, along / length2}});
}

/// Reduces a triangle to the vertex, the edge or the face that contains its point closest to the origin. Only scalar
/// products distinguish the cases, so the function also works in the plane (Ericson, Real-Time Collision Detection,
/// section 5.1.5).
template <int Dim>
void reduce_triangle(Simplex<Dim>& s) {
  const Vec<Dim>&a = s.corner[0].difference, &b = s.corner[1].difference, &c = s.corner[2].difference;
  const Vec<Dim> ab = b - a, ac = c - a;
  const double d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= 0.0 && d2 <= 0.0) return s.keep({{0, 1.0}});
  const double d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= 0.0 && d4 <= d3) return s.keep({{1, 1.0}});
  const double d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= 0.0 && d5 <= d6) return s.keep({{2, 1.0}});
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return s.keep({{0, d3 / (d3 - d1)}, {1, d1 / (d1 - d3)}});
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return s.keep({{0, d6 / (d6 - d2)}, {2, d2 / (d2 - d6)}});
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return s.keep({{1, 1.0 - w}, {2, w}});
  }
  const double sum = va + vb + vc;
  s.keep({{0, va / sum}, {1, vb / sum}, {2, vc / sum}});
}

/// Reduces a tetrahedron to the vertex, the edge or the face that contains its point closest to the origin. Only faces
/// with the origin on the outer side are considered.
/// @return whether the origin is inside the tetrahedron
bool reduce_tetrahedron(Simplex<3>& s) {
  static constexpr std::array<std::array<int, 4>, 4> kFaces = {
      {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
  Simplex<3> best;
  double least = 0.0;
  for (const auto& [a, b, c, d] : kFaces) {
    const Vec<3>& origin = s.corner[a].difference;
    const Vec<3> normal = (s.corner[b].difference - origin).cross(s.corner[c].difference - origin);
    const double here = -normal.dot(origin), top = normal.dot(s.corner[d].difference - origin);
    // If the origin and the fourth corner d are on the same side of this face, the face is skipped, because another
    // face is closer to the origin. A flat tetrahedron has no inside, so all its faces are considered.
    if (here * top > 0.0 && std::abs(top) > 1e-14 * normal.norm() * s.corner[d].difference.norm()) continue;
    Simplex<3> face;
    face.n = 3;
    face.corner[0] = s.corner[a], face.corner[1] = s.corner[b], face.corner[2] = s.corner[c];
    reduce_triangle<3>(face);
    const double distance2 = face.closest().squaredNorm();
    if (best.n == 0 || distance2 < least) best = face, least = distance2;
  }
  if (best.n == 0) return true;
  s = best;
  return false;
}

/// Reduces a simplex to the vertex, the edge or the face that contains its point closest to the origin.
/// @return whether the origin is inside the simplex
bool reduce(Simplex<2>& s) {
  if (s.n == 2) reduce_segment<2>(s);
  if (s.n == 3) reduce_triangle<2>(s);
  return s.n == 3;
}
bool reduce(Simplex<3>& s) {
  if (s.n == 4) return reduce_tetrahedron(s);
  if (s.n == 2) reduce_segment<3>(s);
  if (s.n == 3) reduce_triangle<3>(s);
  return false;
}

template <int Dim>
Corner<Dim> support(const Shape<Dim>& first, const Shape<Dim>& second, const RelativePlace<Dim>& place,
                    const Vec<Dim>& v) {
  Corner<Dim> corner;
  corner.first = lowest_vertex<Dim>(first, -v);
  corner.second = lowest_vertex<Dim>(second, place.rotation.transpose() * v);
  corner.on_first = core_vertex<Dim>(first, corner.first);
  corner.on_second = place.point(core_vertex<Dim>(second, corner.second));
  corner.difference = corner.on_second - corner.on_first;
  return corner;
}

template <int Dim>
int n_distinct(const Simplex<Dim>& s, int Corner<Dim>::*vertex) {
  int n = 0;
  for (int k = 0; k < s.n; ++k) {
    bool is_new = true;
    for (int l = 0; l < k; ++l) is_new = is_new && s.corner[l].*vertex != s.corner[k].*vertex;
    n += is_new ? 1 : 0;
  }
  return n;
}

/// Recomputes v, the point of the simplex closest to the origin, by projecting the origin onto the plane (2D: line) of
/// the simplex. The result has smaller rounding errors than the weighted sum of the corners.
void refine(const Simplex<2>& s, Vec<2>& v) {
  if (s.n != 2) return;
  const Vec<2> side = s.corner[1].difference - s.corner[0].difference;
  const Vec<2> n(-side[1], side[0]);
  v = n * (n.dot(s.corner[0].difference) / n.squaredNorm());
}
void refine(const Simplex<3>& s, Vec<3>& v) {
  if (s.n != 3) return;
  const Vec<3>& a = s.corner[0].difference;
  const Vec<3> n = (s.corner[1].difference - a).cross(s.corner[2].difference - a);
  if (n.squaredNorm() > 0.0) v = n * (n.dot(a) / n.squaredNorm());
}

}  // namespace

template <int Dim>
ClosestPoints<Dim> closest_points(const Shape<Dim>& first, const Shape<Dim>& second,
                                  const RelativePlace<Dim>& place, const Vec<Dim>& guess) {
  constexpr int kMostPasses = 100;
  const double size = first.outer_radius + place.scale * second.outer_radius;
  ClosestPoints<Dim> found;
  Simplex<Dim> s;
  s.corner[0] = support<Dim>(first, second, place, guess);
  s.weight[0] = 1.0;
  s.n = 1;
  Vec<Dim> v = s.corner[0].difference;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const double distance2 = v.squaredNorm();
    if (distance2 <= 1e-24 * size * size) {
      found.overlap = true;
      return found;
    }
    const Corner<Dim> next = support<Dim>(first, second, place, v);
    // The search ends if the new corner, measured along v, is not closer to the origin than the end of v (up to
    // rounding errors), or if the simplex already has this corner.
    if (distance2 - v.dot(next.difference) <= 1e-15 * (distance2 + size * std::sqrt(distance2))) break;
    bool is_known = false;
    for (int k = 0; k < s.n; ++k)
      is_known = is_known || (s.corner[k].first == next.first && s.corner[k].second == next.second);
    if (is_known) break;
    Simplex<Dim> larger = s;
    larger.corner[larger.n++] = next;
    if (reduce(larger)) {
      found.overlap = true;
      return found;
    }
    const Vec<Dim> nearer = larger.closest();
    if (!(nearer.squaredNorm() < distance2)) break;
    s = larger;
    v = nearer;
  }
  refine(s, v);
  found.distance = v.norm();
  found.normal = v / found.distance;
  found.on_first = found.on_second = Vec<Dim>::Zero();
  for (int k = 0; k < s.n; ++k) {
    found.on_first += s.weight[k] * s.corner[k].on_first;
    found.on_second += s.weight[k] * s.corner[k].on_second;
  }
  found.n_first = n_distinct<Dim>(s, &Corner<Dim>::first);
  found.n_second = n_distinct<Dim>(s, &Corner<Dim>::second);
  return found;
}

template ClosestPoints<2> closest_points(const Shape<2>&, const Shape<2>&, const RelativePlace<2>&,
                                         const Vec<2>&);
template ClosestPoints<3> closest_points(const Shape<3>&, const Shape<3>&, const RelativePlace<3>&,
                                         const Vec<3>&);

}  // namespace floc
