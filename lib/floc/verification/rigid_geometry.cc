#include "floc/verification/rigid_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/packing/contact_order.h"
#include "floc/packing/locate.h"
#include "floc/rigid/contact_points.h"
#include "floc/shape/plane_manifold.h"

namespace floc {
namespace {

/// Fields of ManifoldPoint::key, from its lowest bit.
constexpr std::uint32_t kEdgePair = 1;
constexpr int kIncidentBit = 11, kReferenceBit = 21;
constexpr std::uint32_t kTenBits = 1023, kOfSecond = std::uint32_t{1} << 31;

/// Returns the features that met at a contact point with this key. A search that begins with them finds the contact
/// that was recorded, where another one is as good within the margins of contact_manifold().
template <int Dim>
AxisFeatures features_of(std::uint32_t key, const Shape<Dim>& first, const Shape<Dim>& second) {
  const auto reference = static_cast<int>(key >> kReferenceBit & kTenBits),
             incident = static_cast<int>(key >> kIncidentBit & kTenBits);
  AxisFeatures features;
  if (key & kEdgePair) {
    if (reference >= first.n_edges() || incident >= second.n_edges()) return {};
    features = {AxisKind::kEdgePair, static_cast<std::int16_t>(reference), static_cast<std::int16_t>(incident)};
  } else if (key & kOfSecond) {
    if (reference >= second.n_faces()) return {};
    features = {AxisKind::kFaceOfSecond, 0, static_cast<std::int16_t>(reference)};
  } else {
    if (reference >= first.n_faces()) return {};
    features = {AxisKind::kFaceOfFirst, static_cast<std::int16_t>(reference), 0};
  }
  return features;
}

/// Returns the manifold of the two bodies of a contact.
template <int Dim>
Manifold<Dim> manifold_of(const Packing<Dim>& packing, const Contact<Dim>& c, const Vec<Dim>& r, double reach) {
  const PlacedShape<Dim> first = packing.grains.placed(c.i);
  if (packing.is_wall(c.j)) {
    const Wall<Dim>& wall = packing.wall(c.j);
    return plane_manifold(first, wall.normal(), wall.side * wall.position, reach);
  }
  PlacedShape<Dim> second = packing.grains.placed(c.j);
  second.position = first.position + r;
  AxisFeatures features = features_of(static_cast<std::uint32_t>(c.key), *first.shape, *second.shape);
  return contact_manifold(first, second, reach, &features);
}

template <int Dim>
const ManifoldPoint<Dim>* point_with_key(const Manifold<Dim>& manifold, int key) {
  for (int p = 0; p < manifold.n; ++p)
    if (static_cast<int>(manifold.points[p].key) == key) return &manifold.points[p];
  return nullptr;
}

template <int Dim>
const ManifoldPoint<Dim>* nearest_point(const Manifold<Dim>& manifold, const Vec<Dim>& arm) {
  const ManifoldPoint<Dim>* nearest = nullptr;
  for (int p = 0; p < manifold.n; ++p)
    if (!nearest || (manifold.points[p].arm - arm).squaredNorm() < (nearest->arm - arm).squaredNorm())
      nearest = &manifold.points[p];
  return nearest;
}

/// Gives a recorded contact the geometry that follows from positions and shapes.
/// @param tolerance  gap up to which contact points count, over the diameter of the smaller grain
template <int Dim>
Contact<Dim> relocated(const Packing<Dim>& packing, Contact<Dim> c, double tolerance) {
  if (packing.grains.are_round()) {
    place(locate(packing, c), c);
    return c;
  }
  const Vec<Dim> r = branch(packing, c);
  // Recorded gaps may be wrong, but no contact that could count is further apart than the tolerance.
  const double counted = tolerance * smaller_diameter(packing, c);
  Manifold<Dim> manifold = manifold_of(packing, c, r, std::max(std::abs(c.gap), counted) * 1.01);
  const ContactType type = manifold_of(packing, c, r, counted).type;
  const ManifoldPoint<Dim>* found = point_with_key(manifold, c.key);
  // A manifold keeps four of the points with a gap below its reach: with a larger reach they may be others.
  if (!found) {
    manifold = manifold_of(packing, c, r, smaller_diameter(packing, c));
    found = point_with_key(manifold, c.key);
  }
  if (!found) found = nearest_point<Dim>(manifold, c.arm_i);
  c.gap = found ? found->gap : std::numeric_limits<double>::infinity();
  if (!found) return c;
  c.normal = manifold.normal;
  c.type = type;
  c.arm_i = found->arm;
  c.arm_j = found->arm - r;
  return c;
}

}  // namespace

template <int Dim>
double smaller_diameter(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  const std::vector<double>& radius = packing.grains.radius;
  return 2.0 *
         (packing.is_wall(contact.j) ? radius[contact.i] : std::min(radius[contact.i], radius[contact.j]));
}

template <int Dim>
RigidGeometry<Dim> rigid_geometry(const Packing<Dim>& packing, double tolerance) {
  RigidGeometry<Dim> out;
  for (const Contact<Dim>& c : packing.contacts) out.recorded.push_back(relocated(packing, c, tolerance));
  for (const Contact<Dim>& c : ContactPoints<Dim>().find(packing, 0.0)) {
    const double overlap = -c.gap / smaller_diameter(packing, c);
    out.deepest = std::max(out.deepest, overlap);
    if (overlap > tolerance) out.overlapping.push_back(c);
  }
  std::ranges::stable_sort(out.overlapping, [&](const Contact<Dim>& c, const Contact<Dim>& d) {
    return c.gap / smaller_diameter(packing, c) < d.gap / smaller_diameter(packing, d);
  });
  return out;
}

#define FLOC_INSTANTIATE(Dim)                                                 \
  template double smaller_diameter(const Packing<Dim>&, const Contact<Dim>&); \
  template RigidGeometry<Dim> rigid_geometry(const Packing<Dim>&, double);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
