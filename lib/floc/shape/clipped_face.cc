#include "floc/shape/clipped_face.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace floc {
namespace {

constexpr int kReferenceSide = 512;

/// Convex polygon during the clipping. In 2D it is a segment, stored as a polygon with two sides in opposite
/// directions.
template <int Dim>
struct Polygon {
  using Point = typename ClippedFace<Dim>::Point;
  /// Largest number of corners. The polygon is clipped by each side of the reference face, and each side can add one
  /// corner.
  static constexpr int kMost = 2 * kMostVertices + 4;

  int n = 0;
  std::array<Point, kMost> points;

  void add(const Vec<Dim>& x, int side) {
    if (n < kMost) points[n++] = {x, 0.0, side};
  }
};

/// Returns the face at a vertex whose normal is closest to -n. If `level` is positive, only some faces at the vertex
/// are considered: those with the largest number of vertices that are at most `level` (in the unit of the shape) higher
/// than the vertex, measured along n.
template <int Dim>
int most_antiparallel_face(const Shape<Dim>& incident, int vertex, const Vec<Dim>& n, double level) {
  int best = -1;
  double least = 2.0;
  std::ptrdiff_t most = 0;
  const double top = n.dot(incident.vertices[vertex]) + level;
  for (const int f : incident.faces_at(vertex)) {
    const double cosine = incident.normals[f].dot(n);
    const std::ptrdiff_t n_low =
        level > 0.0
            ? std::ranges::count_if(incident.loop(f), [&](int v) { return n.dot(incident.vertices[v]) <= top; })
            : 0;
    if (n_low > most || (n_low == most && cosine < least)) most = n_low, least = cosine, best = f;
  }
  return best;
}

template <int Dim>
void clip(const Vec<Dim>& origin, const Vec<Dim>& outward, int side, const Polygon<Dim>& from,
          Polygon<Dim>& to) {
  to.n = 0;
  const auto height = [&](int k) { return outward.dot(from.points[k].x - origin); };
  double here = height(0);
  for (int k = 0; k < from.n; ++k) {
    const auto& p = from.points[k];
    const auto& q = from.points[k + 1 < from.n ? k + 1 : 0];
    const double there = k + 1 < from.n ? height(k + 1) : height(0);
    if (here <= 0.0) to.add(p.x, p.side);
    if ((here <= 0.0) != (there <= 0.0)) {
      // Each corner stores the number of the side that begins there. The boundary of the polygon leaves the half-space
      // at a corner and enters it again at another corner. The new side, with the number `side`, begins at the first of
      // these corners. The rest of the cut side p.side begins at the second.
      const double share = here / (here - there);
      to.add(p.x + share * (q.x - p.x), here <= 0.0 ? side : p.side);
    }
    here = there;
  }
}

/// Returns the plane that contains side k of a face and is perpendicular to the face: a point of the plane, and a
/// normal of any length that points away from the face.
std::pair<Vec<3>, Vec<3>> side_plane(const Shape<3>& shape, int face, int k) {
  const std::span<const int> loop = shape.loop(face);
  const Vec<3>& from = shape.vertices[loop[k]];
  const Vec<3>& to = shape.vertices[loop[k + 1 < static_cast<int>(loop.size()) ? k + 1 : 0]];
  return {from, (to - from).cross(shape.normals[face])};
}
std::pair<Vec<2>, Vec<2>> side_plane(const Shape<2>& shape, int face, int k) {
  const std::span<const int> loop = shape.loop(face);
  const Vec<2>& end = shape.vertices[loop[k]];
  return {end, end - shape.vertices[loop[1 - k]]};
}

/// Merges adjacent corners whose distance is at most `tolerance`. The merged corner keeps the lower of the two side
/// numbers: sides of the incident face have lower numbers than sides of the reference face, and are preferred.
template <int Dim>
void join_equal_points(Polygon<Dim>& polygon, double tolerance) {
  int n = 0;
  for (int k = 0; k < polygon.n; ++k) {
    auto& p = polygon.points[k];
    bool is_new = true;
    // If the polygon is a segment, stored in both directions, a corner can be equal to any earlier corner, not only to
    // the previous one.
    for (int l = polygon.n <= 4 ? 0 : std::max(0, n - 1); l < n && is_new; ++l)
      if ((polygon.points[l].x - p.x).squaredNorm() <= tolerance * tolerance) {
        polygon.points[l].side = std::min(polygon.points[l].side, p.side);
        is_new = false;
      }
    if (is_new) polygon.points[n++] = p;
  }
  if (n > 1 && (polygon.points[0].x - polygon.points[n - 1].x).squaredNorm() <= tolerance * tolerance) --n;
  polygon.n = n;
}

}  // namespace

template <int Dim>
ClippedFace<Dim> clipped_face(const Shape<Dim>& reference, int face, const Shape<Dim>& incident,
                              const RelativePlace<Dim>& place, int lowest, const ClipOptions& options) {
  ClippedFace<Dim> kept;
  const Vec<Dim>& n = reference.normals[face];
  Polygon<Dim> one, two;
  Polygon<Dim>*from = &one, *to = &two;
  if (incident.is_round()) {
    from->add(place.offset, 0);
  } else if (incident.n_faces() == 0) {
    for (int v = 0; v < incident.n_vertices(); ++v) from->add(place.point(incident.vertices[v]), v);
  } else {
    kept.incident_face = most_antiparallel_face<Dim>(incident, lowest, place.rotation.transpose() * n,
                                                     options.level / place.scale);
    int side = 0;
    for (const int v : incident.loop(kept.incident_face)) from->add(place.point(incident.vertices[v]), side++);
  }
  const int n_sides = static_cast<int>(reference.loop(face).size());
  for (int k = 0; k < n_sides && from->n > 0; ++k) {
    const auto [origin, outward] = side_plane(reference, face, k);
    clip<Dim>(origin, outward, kReferenceSide + k, *from, *to);
    std::swap(from, to);
  }
  int n_kept = 0;
  for (int k = 0; k < from->n; ++k) {
    auto& p = from->points[k];
    p.height = n.dot(p.x) - reference.offsets[face];
    if (p.height < options.reach) from->points[n_kept++] = p;
  }
  from->n = n_kept;
  join_equal_points<Dim>(*from, options.tolerance);
  kept.points.assign(from->points.begin(), from->points.begin() + from->n);
  return kept;
}

template ClippedFace<2> clipped_face(const Shape<2>&, int, const Shape<2>&, const RelativePlace<2>&, int,
                                     const ClipOptions&);
template ClippedFace<3> clipped_face(const Shape<3>&, int, const Shape<3>&, const RelativePlace<3>&, int,
                                     const ClipOptions&);

}  // namespace floc
