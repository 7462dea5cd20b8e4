#include "floc/shape/manifold.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "floc/shape/clipped_face.h"
#include "floc/shape/closest_points.h"

namespace floc {
namespace {

/// If the angle between the normal of a face and the line between the closest points of two shapes is below 1e-3
/// radians, the contact is treated as a contact with the face. The constant is 1 - cos of this angle.
constexpr double kAlongFace = 0.5e-3 * 1e-3;
/// Tolerance for contacts with a face, divided by the smaller inner radius of the two shapes. Two shapes are in contact
/// at a face if the smallest gap of the corners above the face exceeds the smallest gap of the shapes by at most this
/// tolerance. The two gaps differ if the point with the smallest gap lies just outside the boundary of the face.
constexpr double kBesideFace = 1e-6;
/// Margins for the choice of the separating axis (AxisMargins), divided by the smaller inner radius. Without margins,
/// two pairs of features could define the axis in turn from step to step. With ManifoldOptions::exact, kFaceMargin is
/// the margin for edges, too. In equilibrium, vertices on which small forces act can have gaps of up to 1e-7, which is
/// less than kFaceMargin.
constexpr double kFaceMargin = 1e-6, kEdgeMargin = 1e-4;
/// Two capsules count as parallel if the sine of the angle between their axes is below this number.
constexpr double kSideBySide = 1e-3;
/// Value that replaces the number of the side in ManifoldPoint::key if the contact point lies between the closest
/// points of two shapes.
constexpr std::uint32_t kClosest = 1023;

std::uint32_t key_of(bool of_second, int reference, int incident, std::uint32_t corner, bool edges) {
  return (of_second ? 1U << 31 : 0U) | static_cast<std::uint32_t>(reference) << 21 |
         static_cast<std::uint32_t>(incident) << 11 | corner << 1 | (edges ? 1U : 0U);
}

/// Search for the contact points of two shapes, in the coordinates of the first shape.
template <int Dim>
class PairSearch {
 public:
  PairSearch(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second, double reach,
             const ManifoldOptions& options)
      : first_(first),
        second_(second),
        a_(*first.shape),
        b_(*second.shape),
        place_(first, second),
        roundings_(first.rounding() + second.rounding()),
        reach_(reach),
        options_(options),
        size_(std::min(first.inner_radius(), second.inner_radius()) / first.scale) {}

  Manifold<Dim> run(AxisFeatures& last) {
    const bool is_faceless = a_.n_faces() == 0 && b_.n_faces() == 0;
    const bool is_rounded = roundings_ > 0.0;
    SeparatingAxis<Dim> axis;
    const double limit = (reach_ + roundings_) / first_.scale;
    if (!is_faceless) {
      axis = separating_axis<Dim>(a_, b_, place_, margins(), limit, last);
      if (axis.separation > limit) return {};
    }
    // The candidates for the separating axis are complete only if the core of each shape (the shape without rounding)
    // has an inside. If a core is a segment, the axes normal to the segment are missing among the candidates.
    const bool is_thin = a_.n_vertices() < 3 || b_.n_vertices() < 3;
    if (is_rounded && (is_thin || axis.separation > 0.0)) {
      const ClosestPoints<Dim> closest = closest_points<Dim>(a_, b_, place_, guess(axis));
      if (!closest.overlap) return of_cores_apart(closest, axis);
      if (is_faceless) return of_crossed_cores();
    }
    if (axis.features.kind == AxisKind::kEdgePair) return of_edge_pair(axis);
    Manifold<Dim> found = of_face(axis, axis.features.kind == AxisKind::kFaceOfSecond);
    if (is_as_deep_as(world(axis.separation) - roundings_, found)) return found;
    // The deepest vertex lies outside the boundary of the face. In this case a pair of edges has a larger separation
    // than the face, but the difference is less than the margin for edges. The search is therefore repeated without
    // this margin. If ManifoldOptions::face_preference is positive and the points above the face are as deep as the
    // edges, the points above the face are returned. The deepest of them is often the crossing of the two edges, so the
    // comparison has a tolerance. Without it, an edge on a face would have two points if it overlaps the face and one
    // point if it is above the face, and forces would jump from step to step.
    if (a_.n_edges() > 0 && b_.n_edges() > 0) {
      AxisFeatures none;
      const SeparatingAxis<Dim> exact =
          separating_axis<Dim>(a_, b_, place_, {margins().faces, 0.0}, limit, none);
      if (exact.features.kind == AxisKind::kEdgePair) {
        const double gap = world(exact.separation) - roundings_;
        if (options_.face_preference > 0.0 && is_as_deep_as(gap, found)) return found;
        last = none;
        return of_edge_pair(exact);
      }
    }
    if (const auto closest = closest_if_apart(axis)) return of_closest_points(*closest);
    return found.n() > 0 ? found : of_deepest_vertex(axis);
  }

 private:
  AxisMargins margins() const {
    const double least = options_.least_margin / first_.scale;
    return {std::max(kFaceMargin * size_, least),
            std::max((options_.exact ? kFaceMargin : kEdgeMargin) * size_, least), options_.face_preference};
  }

  double world(double own) const { return first_.scale * own; }

  /// Returns whether a contact point found above a face has a gap of at most `gap`, up to the tolerance kBesideFace.
  bool is_as_deep_as(double gap, const Manifold<Dim>& found) const {
    return found.least_gap() - gap <= kBesideFace * world(size_);
  }

  /// Returns the direction with which the search for the closest points begins: the direction of the separating axis.
  Vec<Dim> guess(const SeparatingAxis<Dim>& axis) const {
    if (axis.features.kind == AxisKind::kFaceOfFirst && axis.of_first.face >= 0)
      return a_.normals[axis.of_first.face];
    if (axis.features.kind == AxisKind::kFaceOfSecond && axis.of_second.face >= 0)
      return -place_.direction(b_.normals[axis.of_second.face]);
    return place_.offset;
  }

  /// Adds a contact point to `found`.
  /// @param x  point midway between the surfaces of the two shapes, in the coordinates of the first shape
  void add(Manifold<Dim>& found, const Vec<Dim>& x, double gap, std::uint32_t key) const {
    found.points.push_back({first_.rotation * (first_.scale * x), gap, key});
  }

  /// Returns the point midway between the surfaces of two rounded shapes. The arguments are two points of the cores
  /// (the shapes without rounding) that face each other along n.
  Vec<Dim> midway(const Vec<Dim>& on_first, const Vec<Dim>& on_second, const Vec<Dim>& n) const {
    return 0.5 * (on_first + on_second) + 0.5 * (first_.rounding() - second_.rounding()) / first_.scale * n;
  }

  Manifold<Dim> of_cores_apart(const ClosestPoints<Dim>& closest, const SeparatingAxis<Dim>& axis) {
    const double gap = world(closest.distance) - roundings_;
    if (!(gap < reach_)) return {};
    // Disks and spheres have no faces, so there is no contact with a face.
    if (!a_.is_round() && !b_.is_round()) {
      const bool prefers_second = axis.features.kind == AxisKind::kFaceOfSecond;
      for (const bool of_second : {prefers_second, !prefers_second})
        if (is_along_face(closest.normal, axis, of_second))
          if (Manifold<Dim> found = of_face(axis, of_second); is_as_deep_as(gap, found)) return found;
      if constexpr (Dim == 3) {
        if (a_.n_faces() == 0 && b_.n_faces() == 0)
          if (Manifold<Dim> found = of_capsules_side_by_side(); found.n() > 0) return found;
      }
    }
    return of_closest_points(closest);
  }

  /// Returns the closest points of the cores (the shapes without rounding) if the cores are apart along the separating
  /// axis; otherwise no value.
  std::optional<ClosestPoints<Dim>> closest_if_apart(const SeparatingAxis<Dim>& axis) const {
    if (!(axis.separation > 0.0)) return std::nullopt;
    const ClosestPoints<Dim> closest = closest_points<Dim>(a_, b_, place_, guess(axis));
    return closest.overlap ? std::nullopt : std::optional(closest);
  }

  /// Returns a contact with one point, midway between the closest points of the two shapes.
  Manifold<Dim> of_closest_points(const ClosestPoints<Dim>& closest) const {
    Manifold<Dim> found;
    const double gap = world(closest.distance) - roundings_;
    if (!(gap < reach_)) return found;
    found.normal = first_.rotation * closest.normal;
    found.type = Dim == 3 && closest.n_first == 2 && closest.n_second == 2 ? ContactType::kEdgeEdge
                                                                           : ContactType::kVertexFace;
    add(found, midway(closest.on_first, closest.on_second, closest.normal), gap,
        key_of(false, 0, 0, kClosest, false));
    return found;
  }

  bool is_along_face(const Vec<Dim>& n, const SeparatingAxis<Dim>& axis, bool of_second) const {
    const FaceAxis& face = of_second ? axis.of_second : axis.of_first;
    if (face.face < 0) return false;
    const Vec<Dim> outward =
        of_second ? Vec<Dim>(-place_.direction(b_.normals[face.face])) : a_.normals[face.face];
    return 1.0 - outward.dot(n) < kAlongFace;
  }

  /// Returns the contact points of the face with the largest separation: the corners of the other shape above this
  /// face. The face belongs to the first shape or, if `of_second` is true, to the second shape.
  Manifold<Dim> of_face(const SeparatingAxis<Dim>& axis, bool of_second) {
    const FaceAxis& best = of_second ? axis.of_second : axis.of_first;
    Manifold<Dim> found;
    if (best.face < 0) return found;
    const Shape<Dim>&reference = of_second ? b_ : a_, &incident = of_second ? a_ : b_;
    // The contact is computed in the coordinates of the shape with the reference face. All lengths are therefore
    // converted to the unit of length of this shape.
    const double scale = of_second ? second_.scale : first_.scale;
    const RelativePlace<Dim> place = of_second ? place_.inverse() : place_;
    const double size = size_ * first_.scale / scale;
    // The gap between the rounded surfaces is the height of a corner of the core minus roundings_, the sum of both
    // radii of rounding. Corners up to the height reach_ + roundings_ are therefore within reach.
    const ClippedFace<Dim> clipped = clipped_face<Dim>(reference, best.face, incident, place, best.vertex,
                                                       {.reach = (reach_ + roundings_) / scale,
                                                        .tolerance = 1e-9 * size,
                                                        .level = options_.exact ? kFaceMargin * size : 0.0});
    const Vec<Dim> outward = reference.normals[best.face];
    const Vec<Dim> n = of_second ? Vec<Dim>(-place_.direction(outward)) : outward;
    found.normal = first_.rotation * n;
    found.points.reserve(clipped.points.size());
    for (const auto& p : clipped.points) {
      // The corner belongs to the incident core, and its foot lies on the plane of the reference face. The function
      // midway() expects the point of the first shape before the point of the second shape.
      const Vec<Dim> foot = p.x - p.height * outward;
      const Vec<Dim> x = of_second ? midway(place_.point(p.x), place_.point(foot), n) : midway(foot, p.x, n);
      add(found, x, scale * p.height - roundings_,
          key_of(of_second, best.face, clipped.incident_face, static_cast<std::uint32_t>(p.side), false));
    }
    found.type = type_of(found.n());
    return found;
  }

  static ContactType type_of(int n) {
    if (n <= 1) return ContactType::kVertexFace;
    return n == 2 && Dim == 3 ? ContactType::kDouble : ContactType::kFaceFace;
  }

  Manifold<Dim> of_edge_pair(const SeparatingAxis<Dim>& axis) {
    Manifold<Dim> found;
    const double gap = world(axis.separation) - roundings_;
    if constexpr (Dim == 3) {
      if (!(gap < reach_)) return found;
      const ShapeEdge &e = a_.edges[axis.features.first], &f = b_.edges[axis.features.second];
      const Vec<3> p = a_.vertices[e.from], u = a_.vertices[e.to] - p;
      const Vec<3> q = place_.point(b_.vertices[f.from]), v = place_.point(b_.vertices[f.to]) - q;
      const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), pu = u.dot(q - p), pv = v.dot(q - p);
      const double determinant = uu * vv - uv * uv;
      const double on_first = (pu * vv - pv * uv) / determinant, on_second = (pu * uv - pv * uu) / determinant;
      const double s = std::clamp(on_first, 0.0, 1.0), t = std::clamp(on_second, 0.0, 1.0);
      // The points are the closest points of the lines through the two edges. If the cores overlap, these points lie on
      // the edges (up to rounding errors), because the arcs of the edges on the Gauss sphere cross. If the cores are
      // apart, a vertex may be closer, and the points may then lie outside the edges.
      const double outside = std::abs(on_first - s) * std::sqrt(uu) + std::abs(on_second - t) * std::sqrt(vv);
      if (outside > kBesideFace * size_)
        if (const auto closest = closest_if_apart(axis)) return of_closest_points(*closest);
      const Vec<3> n = edge_pair_normal(a_, axis.features.first, b_, axis.features.second, place_);
      found.normal = first_.rotation * n;
      found.type = ContactType::kEdgeEdge;
      add(found, midway(p + s * u, q + t * v, n), gap,
          key_of(false, axis.features.first, axis.features.second, 0, true));
    }
    return found;
  }

  /// Returns the contact of two overlapping shapes if rounding errors prevent of_face() from finding a contact point:
  /// the separating axis is the normal of a face, but no corner of the other shape is above this face. The contact
  /// point is at the vertex of the other shape with the smallest height above the plane of the face.
  Manifold<Dim> of_deepest_vertex(const SeparatingAxis<Dim>& axis) {
    const bool of_second = axis.features.kind == AxisKind::kFaceOfSecond;
    const FaceAxis& best = of_second ? axis.of_second : axis.of_first;
    Manifold<Dim> found;
    const double gap = world(axis.separation) - roundings_;
    if (best.face < 0 || !(gap < reach_)) return found;
    const Vec<Dim> n = of_second ? Vec<Dim>(-place_.direction(b_.normals[best.face])) : a_.normals[best.face];
    const Shape<Dim>& incident = of_second ? a_ : b_;
    const Vec<Dim> own = core_vertex<Dim>(incident, best.vertex);
    const Vec<Dim> x = of_second ? own : place_.point(own);
    found.normal = first_.rotation * n;
    add(found, of_second ? midway(x, x + axis.separation * n, n) : midway(x - axis.separation * n, x, n), gap,
        key_of(of_second, best.face, 0, kClosest, false));
    return found;
  }

  /// Returns the contact of two parallel capsules: the two ends of the section in which the capsules lie side by side.
  /// The normal is that in the middle of the section. The line between the closest points would not serve, because they
  /// change from one end to the other when the capsules turn by a tiny angle, and the normal would jump.
  Manifold<Dim> of_capsules_side_by_side() {
    Manifold<Dim> found;
    const Vec<Dim> p = a_.vertices[0], u = a_.vertices[1] - p;
    const Vec<Dim> q = place_.point(b_.vertices[0]), v = place_.point(b_.vertices[1]) - q;
    const double length = u.norm(), parallel = u.dot(v) / (length * v.norm());
    if (1.0 - parallel * parallel > kSideBySide * kSideBySide) return found;
    // Begin and end of the core segment of the second capsule, as positions along the core segment of the first
    // capsule.
    const Vec<Dim> along = u / length;
    double from = along.dot(q - p), to = along.dot(q + v - p);
    const bool is_turned = from > to;
    if (is_turned) std::swap(from, to);
    const double low = std::max(from, 0.0), high = std::min(to, length);
    if (!(high - low > kSideBySide * size_)) return found;
    const auto on_first = [&](double s) { return Vec<Dim>(p + s * along); };
    const auto on_second = [&](double s) {
      const double share = (s - from) / (to - from);
      return Vec<Dim>(q + (is_turned ? 1.0 - share : share) * v);
    };
    const double middle = 0.5 * (low + high);
    const Vec<Dim> n = (on_second(middle) - on_first(middle)).normalized();
    found.normal = first_.rotation * n;
    for (const double s : {low, high}) {
      const double gap = world(n.dot(on_second(s) - on_first(s))) - roundings_;
      if (gap < reach_)
        add(found, midway(on_first(s), on_second(s), n), gap, key_of(false, 0, 0, s == low ? 0 : 1, false));
    }
    found.type = type_of(found.n());
    return found;
  }

  /// Returns the contact of two disks, spheres or capsules whose cores (centres or segments) intersect. The normal is
  /// perpendicular to both segments; its direction is arbitrary if there are no segments.
  Manifold<Dim> of_crossed_cores() {
    Manifold<Dim> found;
    Vec<Dim> n = Vec<Dim>::Unit(0);
    const auto axis_of = [](const Shape<Dim>& shape) {
      return shape.is_round() ? Vec<Dim>(Vec<Dim>::Zero()) : Vec<Dim>(shape.vertices[1] - shape.vertices[0]);
    };
    const Vec<Dim> u = axis_of(a_), v = place_.direction(axis_of(b_));
    if constexpr (Dim == 3) {
      const Vec<3> longer = u.norm() > v.norm() ? u : v, across = u.cross(v);
      if (across.norm() > kSideBySide * u.norm() * v.norm())
        n = across.normalized();
      else if (!longer.isZero(0.0))
        n = longer.unitOrthogonal();
    }
    if (n.dot(place_.offset) < 0.0) n = -n;
    found.normal = first_.rotation * n;
    add(found, midway(place_.offset, place_.offset, n), -roundings_, key_of(false, 0, 0, kClosest, false));
    return found;
  }

  const PlacedShape<Dim>&first_, &second_;
  const Shape<Dim>&a_, &b_;
  RelativePlace<Dim> place_;
  /// sum of the radii of rounding of both shapes, each multiplied by the scale of its grain (length)
  double roundings_;
  double reach_;
  ManifoldOptions options_;
  double size_;  ///< smaller inner radius of the two shapes, in the unit of length of the first shape
};

}  // namespace

std::string contact_type_name(ContactType type) {
  switch (type) {
    case ContactType::kVertexFace:
      return "vertex-face";
    case ContactType::kEdgeEdge:
      return "edge-edge";
    case ContactType::kDouble:
      return "double";
    case ContactType::kFaceFace:
      break;
  }
  return "face-face";
}

std::optional<ContactType> contact_type_of(std::string_view name) {
  for (const ContactType type :
       {ContactType::kVertexFace, ContactType::kEdgeEdge, ContactType::kDouble, ContactType::kFaceFace})
    if (name == contact_type_name(type)) return type;
  return std::nullopt;
}

bool is_contact_type_in(ContactType type, int dimension) {
  return dimension == 3 || type == ContactType::kVertexFace || type == ContactType::kFaceFace;
}

template <int Dim>
AxisFeatures axis_features(std::uint32_t key, const Shape<Dim>& first, const Shape<Dim>& second) {
  constexpr std::uint32_t kTenBits = 1023;
  const bool of_second = (key >> 31) != 0, edges = (key & 1U) != 0;
  const auto reference = static_cast<std::int16_t>(key >> 21 & kTenBits);
  const auto incident = static_cast<std::int16_t>(key >> 11 & kTenBits);
  if (edges)
    return reference < first.n_edges() && incident < second.n_edges()
               ? AxisFeatures{AxisKind::kEdgePair, reference, incident}
               : AxisFeatures{};
  if ((key >> 1 & kTenBits) == kClosest || reference >= (of_second ? second : first).n_faces()) return {};
  return of_second ? AxisFeatures{AxisKind::kFaceOfSecond, 0, reference}
                   : AxisFeatures{AxisKind::kFaceOfFirst, reference, 0};
}

template <int Dim>
const ManifoldPoint<Dim>* Manifold<Dim>::with_key(std::uint32_t key) const {
  for (const ManifoldPoint<Dim>& point : points)
    if (point.key == key) return &point;
  return nullptr;
}

template <int Dim>
const ManifoldPoint<Dim>* Manifold<Dim>::nearest(const Vec<Dim>& arm) const {
  const ManifoldPoint<Dim>* found = nullptr;
  for (const ManifoldPoint<Dim>& point : points)
    if (!found || (point.arm - arm).squaredNorm() < (found->arm - arm).squaredNorm()) found = &point;
  return found;
}

template <int Dim>
double Manifold<Dim>::least_gap() const {
  double least = std::numeric_limits<double>::infinity();
  for (const ManifoldPoint<Dim>& point : points) least = std::min(least, point.gap);
  return least;
}

template <int Dim>
Manifold<Dim> contact_manifold(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second, double reach,
                               AxisFeatures* last, const ManifoldOptions& options) {
  AxisFeatures none;
  return PairSearch<Dim>(first, second, reach, options).run(last != nullptr ? *last : none);
}

template struct Manifold<2>;
template struct Manifold<3>;
template AxisFeatures axis_features(std::uint32_t, const Shape<2>&, const Shape<2>&);
template AxisFeatures axis_features(std::uint32_t, const Shape<3>&, const Shape<3>&);
template Manifold<2> contact_manifold(const PlacedShape<2>&, const PlacedShape<2>&, double, AxisFeatures*,
                                      const ManifoldOptions&);
template Manifold<3> contact_manifold(const PlacedShape<3>&, const PlacedShape<3>&, double, AxisFeatures*,
                                      const ManifoldOptions&);

}  // namespace floc
