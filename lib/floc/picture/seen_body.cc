#include "floc/picture/seen_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "floc/picture/seen_packing.h"

namespace floc {
namespace {

/// A facet counts as seen edge-on if its unit normal has a component along the line of sight below this limit.
constexpr double kFaceEndOn = 1e-9;

/// Part of a line segment, stored as fractions of the length of the segment. The part is the whole segment at first;
/// each call of cut() shortens it.
class CutSegment {
 public:
  CutSegment(const Vec<3>& from, const Vec<3>& to) : from_(from), along_(to - from) {}

  /// Cuts away all points x with normal . x > offset.
  void cut(const Vec<3>& normal, double offset) {
    const double above = normal.dot(from_) - offset, rise = normal.dot(along_);
    if (rise > 0.0)
      end_ = std::min(end_, -above / rise);
    else if (rise < 0.0)
      begin_ = std::max(begin_, -above / rise);
    else if (above > 0.0)
      end_ = begin_;
  }
  bool is_empty() const { return begin_ >= end_; }
  std::pair<double, double> part() const { return {begin_, end_}; }

 private:
  Vec<3> from_, along_;
  double begin_ = 0.0, end_ = 1.0;
};

void add_hidden_by_facets(const Vec<3>& from, const Vec<3>& to, const SeenBody& body,
                          std::vector<std::pair<double, double>>& hidden) {
  // The hidden region consists of the body and of all points behind the body. The region is bounded by two kinds of
  // planes: the planes of the facets that face the eye, and the planes along the line of sight through the edges of the
  // outline. An edge belongs to the outline if it borders only one facet that faces the eye.
  CutSegment segment(from, to);
  std::set<std::pair<int, int>> sides;
  for (const Facets::Facet& facet : body.facets) {
    double offset = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < facet.corners.size(); ++k) {
      offset = std::max(offset, facet.normal.dot(body.points[facet.corners[k]]));
      sides.emplace(facet.corners[k], facet.corners[(k + 1) % facet.corners.size()]);
    }
    segment.cut(facet.normal, offset);
    if (segment.is_empty()) return;
  }
  for (const auto& [a, b] : sides) {
    if (sides.contains({b, a})) continue;
    const Vec<3> side = body.points[b] - body.points[a];
    const Vec<3> out(side[1], -side[0], 0.0);
    segment.cut(out, out.dot(body.points[a]));
  }
  if (!segment.is_empty()) hidden.push_back(segment.part());
}

/// Adds the parts of a line segment that a capsule hides. A row of spheres replaces the capsule. The outlines of the
/// spheres and of the capsule differ by less than 1 % of the radius.
void add_hidden_by_capsule(const Vec<3>& from, const Vec<3>& to, const SeenBody& body,
                           std::vector<std::pair<double, double>>& hidden) {
  constexpr double kStep = 0.25;  // distance between the centres, divided by the radius
  const Vec<3> axis = body.points[1] - body.points[0];
  const int n = 1 + static_cast<int>(std::ceil(axis.norm() / (kStep * body.rounding)));
  for (int k = 0; k < n; ++k) {
    const Vec<3> centre = body.points[0] + axis * (static_cast<double>(k) / std::max(1, n - 1));
    if (const auto part = hidden_part(from, to, {centre, body.rounding, body.grain})) hidden.push_back(*part);
  }
}

/// Returns the distance from the centre of a capsule to its surface in a given direction.
/// @param along  component of the direction (a unit vector) along the axis of the capsule
double distance_in_capsule(double half_length, double radius, double along) {
  const double across = std::sqrt(std::max(0.0, 1.0 - along * along));
  const double to_cylinder = radius / std::max(across, 1e-12);
  if (to_cylinder * along <= half_length) return to_cylinder;
  // At the distance t from the centre, the direction meets the sphere around the end of the axis. This t solves (t - h
  // along)^2 + h^2 across^2 = radius^2, with h = half_length.
  const double beside = half_length * across;
  return half_length * along + std::sqrt(std::max(0.0, radius * radius - beside * beside));
}

}  // namespace

SeenBody seen_body(const PlacedShape<3>& placed, const Facets& facets, const Camera& camera, int grain) {
  SeenBody body{camera.seen(placed.position), placed.outer_radius(), grain, {}, {}, placed.rounding()};
  const bool is_capsule = placed.shape->n_faces() == 0;
  for (const Vec<3>& x : is_capsule ? placed.shape->vertices : facets.points)
    body.points.push_back(camera.seen(placed.position + placed.scale * (placed.rotation * x)));
  if (is_capsule) return body;
  for (const Facets::Facet& facet : facets.facets) {
    const Vec<3> normal = camera.seen(placed.rotation * facet.normal);
    if (normal[2] > kFaceEndOn) body.facets.push_back({facet.corners, normal});
  }
  return body;
}

void add_hidden_parts(const Vec<3>& from, const Vec<3>& to, const SeenBody& body,
                      std::vector<std::pair<double, double>>& hidden) {
  if (!hidden_part(from, to, {body.centre, body.radius, body.grain})) return;
  if (body.facets.empty())
    add_hidden_by_capsule(from, to, body, hidden);
  else
    add_hidden_by_facets(from, to, body, hidden);
}

double distance_to_surface(const PlacedShape<3>& placed, const Vec<3>& direction) {
  const Shape<3>& shape = *placed.shape;
  const Vec<3> own = placed.rotation.transpose() * direction;
  if (shape.is_round()) return placed.rounding();
  if (shape.n_faces() == 0) {
    const Vec<3> half = 0.5 * (shape.vertices[1] - shape.vertices[0]);
    return placed.scale *
           distance_in_capsule(half.norm(), shape.rounding, std::abs(own.dot(half.normalized())));
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (int f = 0; f < shape.n_faces(); ++f)
    if (const double slope = shape.normals[f].dot(own); slope > 0.0)
      nearest = std::min(nearest, (shape.offsets[f] + shape.rounding) / slope);
  return placed.scale * nearest;
}

}  // namespace floc
