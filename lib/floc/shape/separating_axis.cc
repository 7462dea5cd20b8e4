#include "floc/shape/separating_axis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace floc {
namespace {

constexpr double kLeast = -std::numeric_limits<double>::max();
/// Two edges count as parallel if the sine of the angle between them is smaller than this number. Parallel edges define
/// no axis; the normal of a face is used instead.
constexpr double kParallel = 1e-9;

/// Search for the face of the shape `one` with the largest separation from the shape `other`. The separation of a face
/// is the height of the lowest vertex of `other` above the plane of the face.
template <int Dim>
class FaceSearch {
 public:
  /// @param place  transformation from the coordinates of `other` to the coordinates of `one`
  FaceSearch(const Shape<Dim>& one, const Shape<Dim>& other, const RelativePlace<Dim>& place)
      : one_(one), other_(other), place_(place) {}

  double separation(int face) {
    const Vec<Dim>& n = one_.normals[face];
    vertex_ = lowest_vertex<Dim>(other_, place_.rotation.transpose() * n);
    const Vec<Dim> point = place_.point(core_vertex<Dim>(other_, vertex_));
    if (n_points_ < kMostPoints)
      points_[n_points_++] = point;
    else
      points_[1 + vertex_ % (kMostPoints - 1)] = point;
    return n.dot(point) - one_.offsets[face];
  }

  /// Finds the face with the largest separation.
  /// @param begin  index of the face with which the search begins; for -1, the search begins with the face that has the
  /// centre of the other shape highest above it
  FaceAxis best(int begin, double margin, double limit) {
    FaceAxis found;
    if (one_.n_faces() == 0) {
      found.separation = kLeast;
      return found;
    }
    const bool prefers = begin >= 0 && begin < one_.n_faces();
    if (!prefers) begin = face_towards(place_.offset);
    found = {begin, 0, separation(begin)};
    found.vertex = vertex_;
    for (int f = 0; f < one_.n_faces() && found.separation <= limit; ++f) {
      // The face of the previous step is kept unless the separation of another face is larger by more than the margin.
      const double threshold = found.separation + (prefers && found.face == begin ? margin : 0.0);
      if (f == begin || !may_exceed(f, threshold)) continue;
      const double here = separation(f);
      if (here > threshold) found = {f, vertex_, here};
    }
    return found;
  }

  /// Returns false if a given edge of the shape `one`, paired with any edge of the other shape, cannot have a
  /// separation above a threshold.
  ///
  /// Let a and b be the normals of the two faces at the edge. The normal of an edge pair is n = alpha a + beta b with
  /// alpha, beta >= 0 and 1 <= alpha + beta <= sqrt(2/(1 + a . b)). For any point p of the other shape, the height of p
  /// above the edge, measured along n, is an upper bound of the separation. This height is alpha times the height of p
  /// above face a, plus beta times the height of p above face b.
  bool edge_may_exceed(const ShapeEdge& edge, double threshold) const {
    const Vec<Dim>&a = one_.normals[edge.left], &b = one_.normals[edge.right];
    for (int k = 0; k < n_points_; ++k) {
      const double most =
          std::max(a.dot(points_[k]) - one_.offsets[edge.left], b.dot(points_[k]) - one_.offsets[edge.right]);
      if (most >= threshold) continue;
      if (most <= 0.0 || 2.0 * most * most < threshold * threshold * (1.0 + a.dot(b))) return false;
    }
    return true;
  }

 private:
  static constexpr int kMostPoints = 6;

  int face_towards(const Vec<Dim>& point) const {
    int best = 0;
    double most = kLeast;
    for (int f = 0; f < one_.n_faces(); ++f) {
      const double height = one_.normals[f].dot(point) - one_.offsets[f];
      if (height > most) most = height, best = f;
    }
    return best;
  }

  /// Returns false if the separation of a face cannot exceed a threshold. The separation of the face is at most the
  /// height of any point of the other shape above the face.
  bool may_exceed(int face, double threshold) const {
    for (int k = 0; k < n_points_; ++k)
      if (one_.normals[face].dot(points_[k]) - one_.offsets[face] <= threshold) return false;
    return true;
  }

  const Shape<Dim>& one_;
  const Shape<Dim>& other_;
  const RelativePlace<Dim>& place_;
  /// Lowest points of the other shape above the faces examined so far; at most kMostPoints points are stored.
  std::array<Vec<Dim>, kMostPoints> points_;
  int n_points_ = 0;
  int vertex_ = 0;  ///< lowest vertex of the other shape above the last face examined
};

/// Edge of a shape and the normals of the two faces that meet at the edge, in the coordinates of the first shape of the
/// pair.
struct PlacedEdge {
  Vec<3> from, along, left, right;
};

PlacedEdge edge_of(const Shape<3>& shape, int edge) {
  const ShapeEdge& e = shape.edges[edge];
  const Vec<3>& from = shape.vertices[e.from];
  return {from, shape.vertices[e.to] - from, shape.normals[e.left], shape.normals[e.right]};
}

PlacedEdge edge_of(const Shape<3>& shape, int edge, const RelativePlace<3>& place) {
  const PlacedEdge own = edge_of(shape, edge);
  return {place.point(own.from), Vec<3>(place.scale * place.direction(own.along)), place.direction(own.left),
          place.direction(own.right)};
}

/// Returns whether the arc of edge `a` crosses the reversed arc of edge `b` on the Gauss sphere. The arc of an edge
/// connects the normals of the two faces at the edge. If the arcs cross, the two edges form a face of the Minkowski
/// difference of the two shapes.
bool arcs_cross(const PlacedEdge& a, const PlacedEdge& b) {
  const double c = b.left.dot(a.along), d = b.right.dot(a.along);
  if (!(c * d < 0.0)) return false;
  const double e = a.left.dot(b.along), f = a.right.dot(b.along);
  return e * f < 0.0 && c * f < 0.0;
}

Vec<3> pair_normal(const PlacedEdge& a, const PlacedEdge& b) {
  const Vec<3> n = a.along.cross(b.along);
  const double length = n.norm();
  if (length * length <= kParallel * kParallel * a.along.squaredNorm() * b.along.squaredNorm())
    return Vec<3>::Zero();
  return n.dot(a.left + a.right) < 0.0 ? Vec<3>(n / -length) : Vec<3>(n / length);
}

/// Pair of edges, one of each shape, with the largest separation. The indices are -1 if no pair has a separation above
/// the threshold. The member `of_last` is the separation of the pair of edges that defined the axis in the previous
/// step.
struct EdgeAxis {
  int first = -1, second = -1;
  double separation = kLeast;
  double of_last = kLeast;
};

EdgeAxis best_edge_pair(const Shape<3>& first, const FaceSearch<3>& above_first, const Shape<3>& second,
                        const FaceSearch<3>& above_second, const RelativePlace<3>& place, double threshold,
                        const AxisFeatures& last) {
  std::array<std::int16_t, kMostFaces> candidates;
  int n_candidates = 0;
  for (int e = 0; e < first.n_edges(); ++e)
    if (above_first.edge_may_exceed(first.edges[e], threshold))
      candidates[n_candidates++] = static_cast<std::int16_t>(e);
  EdgeAxis best;
  if (n_candidates == 0) return best;
  for (int other = 0; other < second.n_edges(); ++other) {
    if (!above_second.edge_may_exceed(second.edges[other], threshold / place.scale)) continue;
    const PlacedEdge b = edge_of(second, other, place);
    for (int k = 0; k < n_candidates; ++k) {
      const PlacedEdge a = edge_of(first, candidates[k]);
      if (!arcs_cross(a, b)) continue;
      const Vec<3> n = pair_normal(a, b);
      if (n.isZero(0.0)) continue;
      const double separation = n.dot(b.from - a.from);
      if (candidates[k] == last.first && other == last.second) best.of_last = separation;
      if (separation > best.separation) best = {candidates[k], other, separation, best.of_last};
    }
  }
  return best;
}

/// Returns the separation of two shapes along the axis that is computed from the features of the previous step and the
/// present positions. The separation is a lower bound of the distance of the shapes.
template <int Dim>
double last_separation(const Shape<Dim>& first, const Shape<Dim>& second, const RelativePlace<Dim>& place,
                       const AxisFeatures& last, FaceSearch<Dim>& above_first, FaceSearch<Dim>& above_second) {
  if (last.kind == AxisKind::kFaceOfFirst && last.first < first.n_faces())
    return above_first.separation(last.first);
  if (last.kind == AxisKind::kFaceOfSecond && last.second < second.n_faces())
    return place.scale * above_second.separation(last.second);
  if constexpr (Dim == 3) {
    if (last.kind == AxisKind::kEdgePair && last.first < first.n_edges() && last.second < second.n_edges()) {
      const Vec<3> n = edge_pair_normal(first, last.first, second, last.second, place);
      if (n.isZero(0.0)) return kLeast;
      const int low = lowest_vertex<3>(second, place.rotation.transpose() * n),
                high = lowest_vertex<3>(first, -n);
      return n.dot(place.point(second.vertices[low]) - first.vertices[high]);
    }
  }
  return kLeast;
}

}  // namespace

Vec<3> edge_pair_normal(const Shape<3>& first, int edge, const Shape<3>& second, int other_edge,
                        const RelativePlace<3>& place) {
  return pair_normal(edge_of(first, edge), edge_of(second, other_edge, place));
}

template <int Dim>
SeparatingAxis<Dim> separating_axis(const Shape<Dim>& first, const Shape<Dim>& second,
                                    const RelativePlace<Dim>& place, const AxisMargins& margins, double limit,
                                    AxisFeatures& last) {
  const RelativePlace<Dim> inverse = place.inverse();
  FaceSearch<Dim> above_first(first, second, place), above_second(second, first, inverse);
  SeparatingAxis<Dim> axis;
  axis.features = last;
  axis.separation = last_separation<Dim>(first, second, place, last, above_first, above_second);
  if (axis.separation > limit) return axis;

  const AxisFeatures before = last;
  const auto settle = [&](AxisKind kind, int one, int other, double separation) {
    axis.features = last = {kind, static_cast<std::int16_t>(one), static_cast<std::int16_t>(other)};
    axis.separation = separation;
    return axis;
  };
  FaceAxis& one = axis.of_first =
      above_first.best(before.kind == AxisKind::kFaceOfFirst ? before.first : -1, margins.faces, limit);
  if (one.separation > limit) return settle(AxisKind::kFaceOfFirst, one.face, 0, one.separation);
  FaceAxis& other = axis.of_second =
      above_second.best(before.kind == AxisKind::kFaceOfSecond ? before.second : -1,
                        margins.faces / place.scale, limit / place.scale);
  if (other.face >= 0) other.separation *= place.scale;
  if (other.separation > limit) return settle(AxisKind::kFaceOfSecond, 0, other.face, other.separation);

  const double advantage = before.kind == AxisKind::kFaceOfSecond ? -margins.faces : margins.faces;
  const bool is_other = other.face >= 0 && (one.face < 0 || other.separation > one.separation + advantage);
  const double faces = is_other ? other.separation : one.separation;
  if constexpr (Dim == 3) {
    const bool was_pair = before.kind == AxisKind::kEdgePair;
    const double least = faces + margins.edges_of_overlap * std::max(0.0, -faces);
    const double threshold = least + (was_pair ? -margins.edges : margins.edges);
    const EdgeAxis pair = best_edge_pair(first, above_first, second, above_second, place, threshold, before);
    if (was_pair && pair.of_last >= std::max(least, pair.separation) - margins.edges)
      return settle(AxisKind::kEdgePair, before.first, before.second, pair.of_last);
    if (pair.separation > least + margins.edges)
      return settle(AxisKind::kEdgePair, pair.first, pair.second, pair.separation);
  }
  return is_other ? settle(AxisKind::kFaceOfSecond, 0, other.face, other.separation)
                  : settle(AxisKind::kFaceOfFirst, one.face, 0, one.separation);
}

template SeparatingAxis<2> separating_axis(const Shape<2>&, const Shape<2>&, const RelativePlace<2>&,
                                           const AxisMargins&, double, AxisFeatures&);
template SeparatingAxis<3> separating_axis(const Shape<3>&, const Shape<3>&, const RelativePlace<3>&,
                                           const AxisMargins&, double, AxisFeatures&);

}  // namespace floc
