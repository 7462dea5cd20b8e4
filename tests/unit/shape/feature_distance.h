#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "unit/shape/pairs.h"

/// Computes the distance or the depth of overlap of two shapes from all pairs of their features. The code uses the
/// lists of vertices, faces and edges of the library, but not its contact search.
namespace floc::test {

/// Distance between the cores (shapes without rounding) of two separate shapes, and the kind of their closest
/// features.
struct FeatureDistance {
  double distance = std::numeric_limits<double>::max();
  /// Whether the closest points are a vertex and a point inside a face, or two points inside edges (in 2D: a vertex and
  /// a point inside a side). separating_axis() then also examines the direction of the line between the two points.
  bool is_axis = false;
};

/// Returns the positions in space of the vertices of the core of a shape.
template <int Dim>
std::vector<Vec<Dim>> vertices_in_space(const PlacedShape<Dim>& one) {
  if (one.shape->is_round()) return {one.position};
  std::vector<Vec<Dim>> found;
  for (const Vec<Dim>& v : one.shape->vertices) found.push_back(one.position + one.scale * (one.rotation * v));
  return found;
}

/// Returns the edges of the core of a shape as pairs of vertices. In 2D these are its sides.
template <int Dim>
std::vector<std::array<int, 2>> edges_of(const Shape<Dim>& shape) {
  std::vector<std::array<int, 2>> found;
  if (shape.n_vertices() == 2) return {{0, 1}};
  if constexpr (Dim == 2) {
    for (int f = 0; f < shape.n_faces(); ++f) found.push_back({shape.loop(f)[0], shape.loop(f)[1]});
  } else {
    for (const ShapeEdge& e : shape.edges) found.push_back({e.from, e.to});
  }
  return found;
}

template <int Dim>
void take(FeatureDistance& least, const Vec<Dim>& between, bool is_axis) {
  // Of two distances that are equal up to rounding, the distance with `is_axis` is taken.
  const double distance = between.norm();
  if (distance < least.distance - 1e-13 || (distance < least.distance + 1e-13 && is_axis))
    least.is_axis = is_axis;
  least.distance = std::min(least.distance, distance);
}

/// Updates `least` with the distance of two segments if the closest points of the two lines lie inside the segments.
/// Otherwise an end of a segment is closest; vertex_to_edge() examines the ends.
inline void edge_to_edge(FeatureDistance& least, const Vec<3>& p, const Vec<3>& u, const Vec<3>& q,
                         const Vec<3>& v) {
  const Vec<3> n = u.cross(v);
  const double n2 = n.squaredNorm();
  if (n2 <= 1e-24 * u.squaredNorm() * v.squaredNorm()) return;
  const double s = (q - p).cross(v).dot(n) / n2, t = (q - p).cross(u).dot(n) / n2;
  if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) take<3>(least, n * (n.dot(q - p) / n2), true);
}

template <int Dim>
void vertex_to_edge(FeatureDistance& least, const Vec<Dim>& x, const Vec<Dim>& p, const Vec<Dim>& u) {
  const double s = u.dot(x - p) / u.squaredNorm();
  take<Dim>(least, x - p - std::clamp(s, 0.0, 1.0) * u, Dim == 2 && s >= 0.0 && s <= 1.0);
}

/// Updates `least` with the distances between the vertices of one shape and the faces of the other shape, in 3D.
inline void vertices_to_faces(FeatureDistance& least, const PlacedShape<3>& one, const PlacedShape<3>& other) {
  const std::vector<Vec<3>> corners = vertices_in_space<3>(one), points = vertices_in_space<3>(other);
  for (int f = 0; f < one.shape->n_faces(); ++f) {
    const Vec<3> n = one.rotation * one.shape->normals[f];
    const auto loop = one.shape->loop(f);
    for (const Vec<3>& x : points) {
      bool is_over = true;
      for (std::size_t k = 0; k < loop.size() && is_over; ++k) {
        const Vec<3>&from = corners[loop[k]], &to = corners[loop[(k + 1) % loop.size()]];
        is_over = (to - from).cross(x - from).dot(n) >= 0.0;
      }
      if (is_over) take<3>(least, n * n.dot(x - corners[loop[0]]), true);
    }
  }
}

/// Returns the distance of the cores of two separate shapes.
template <int Dim>
FeatureDistance distance_of_cores(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second) {
  FeatureDistance least;
  const std::vector<Vec<Dim>> a = vertices_in_space<Dim>(first), b = vertices_in_space<Dim>(second);
  for (const Vec<Dim>& x : a)
    for (const Vec<Dim>& y : b) take<Dim>(least, y - x, false);
  for (const auto& e : edges_of<Dim>(*first.shape))
    for (const Vec<Dim>& y : b) vertex_to_edge<Dim>(least, y, a[e[0]], a[e[1]] - a[e[0]]);
  for (const auto& f : edges_of<Dim>(*second.shape))
    for (const Vec<Dim>& x : a) vertex_to_edge<Dim>(least, x, b[f[0]], b[f[1]] - b[f[0]]);
  if constexpr (Dim == 3) {
    for (const auto& e : edges_of<3>(*first.shape))
      for (const auto& f : edges_of<3>(*second.shape))
        edge_to_edge(least, a[e[0]], a[e[1]] - a[e[0]], b[f[0]], b[f[1]] - b[f[0]]);
    vertices_to_faces(least, first, second);
    vertices_to_faces(least, second, first);
  }
  return least;
}

/// Returns the largest separation of the cores of two shapes along the normals of all faces and, in 3D, along the
/// common normals of all pairs of edges. If the cores overlap, the result is minus the depth. If the cores are
/// separate, the result is at most their distance.
template <int Dim>
double separation_over_axes(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second) {
  const std::vector<Vec<Dim>> a = vertices_in_space<Dim>(first), b = vertices_in_space<Dim>(second);
  double most = -std::numeric_limits<double>::max();
  const auto examine = [&](const Vec<Dim>& n) {
    // The centres lie inside the shapes. The separation along n is therefore at most the distance of the centres along
    // n.
    if (n.dot(second.position - first.position) <= most) return;
    double high = -std::numeric_limits<double>::max(), low = -high;
    for (const Vec<Dim>& x : a) high = std::max(high, n.dot(x - first.position));
    for (const Vec<Dim>& y : b) low = std::min(low, n.dot(y - first.position));
    most = std::max(most, low - high);
  };
  for (const Vec<Dim>& n : first.shape->normals) examine(first.rotation * n);
  for (const Vec<Dim>& n : second.shape->normals) examine(-(second.rotation * n));
  if constexpr (Dim == 3) {
    for (const auto& e : edges_of<3>(*first.shape))
      for (const auto& f : edges_of<3>(*second.shape)) {
        const Vec<3> u = a[e[1]] - a[e[0]], v = b[f[1]] - b[f[0]], n = u.cross(v);
        if (n.norm() <= 1e-9 * u.norm() * v.norm()) continue;
        examine(n.normalized());
        examine(-n.normalized());
      }
  }
  return most;
}

/// Gap of two shapes, at least one of which has faces: their distance, or minus the depth of their overlap.
struct FeatureGap {
  double gap;
  bool is_core_apart;  ///< whether the cores (the shapes without rounding) are separate
};
template <int Dim>
FeatureGap gap_of_features(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second) {
  const double roundings = first.rounding() + second.rounding(),
               separation = separation_over_axes(first, second);
  if (separation <= 0.0) return {separation - roundings, false};
  return {distance_of_cores(first, second).distance - roundings, true};
}

/// Moves the second shape along the direction `towards` from the centre of the first shape, until the gap of the two
/// shapes is close to `gap`.
/// @return the gap that is reached
template <int Dim>
FeatureGap set_gap(const PlacedShape<Dim>& first, PlacedShape<Dim>& second, const Vec<Dim>& towards,
                   double gap) {
  double near = 0.0, far = first.outer_radius() + second.outer_radius() + std::max(gap, 0.0);
  const auto excess_at = [&](double distance, FeatureGap& found) {
    second.position = first.position + distance * towards;
    found = gap_of_features<Dim>(first, second);
    return found.gap - gap;
  };
  FeatureGap found;
  double near_excess = excess_at(near, found), far_excess = excess_at(far, found);
  for (int pass = 0; pass < 60 && std::abs(found.gap - gap) > 0.01 * std::abs(gap); ++pass) {
    // Linear interpolation, with a bisection in every third pass.
    const double share = pass % 3 == 2 ? 0.5 : near_excess / (near_excess - far_excess);
    const double distance = near + share * (far - near), excess = excess_at(distance, found);
    (excess < 0.0 ? near : far) = distance;
    (excess < 0.0 ? near_excess : far_excess) = excess;
  }
  return found;
}

}  // namespace floc::test
