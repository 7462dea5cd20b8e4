#include "floc/verification/rigid_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/packing/grain_sizes.h"
#include "floc/packing/locate.h"
#include "floc/rigid/contact_points.h"

namespace floc {
namespace {

/// Fields of ManifoldPoint::key, starting with its lowest bit.
constexpr std::uint32_t kEdgePair = 1;
constexpr int kIncidentBit = 11, kReferenceBit = 21;
constexpr std::uint32_t kTenBits = 1023, kOfSecond = std::uint32_t{1} << 31;

/// Returns the features that meet at a contact point with this key. A search that begins with these features finds the
/// recorded contact. Without them, contact_manifold() could find another contact that is equally good within its
/// margins.
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

/// Returns a recorded contact, but with the geometry that follows from positions and shapes; see rigid_geometry() for
/// the parameters.
template <int Dim>
Contact<Dim> relocated(const Packing<Dim>& packing, Contact<Dim> c, double gap_limit, double error) {
  if (packing.grains.are_round()) {
    place(locate(packing, c), c);
    return c;
  }
  const Vec<Dim> r = branch(packing, c);
  const auto key = static_cast<std::uint32_t>(c.key);
  const double diameter = 2.0 * smaller_radius(packing, c);
  const auto within = [&](double reach) {
    AxisFeatures features;
    if (!packing.is_wall(c.j))
      features = features_of(key, *packing.grains.placed(c.i).shape, *packing.grains.placed(c.j).shape);
    return manifold_of(packing, c, r, reach, &features);
  };
  // The recorded gap may be wrong, so the point is searched for at all gaps. The type follows from the points whose
  // gaps are below the limit.
  const Manifold<Dim> manifold = within(diameter);
  const ManifoldPoint<Dim>* found = manifold.with_key(key);
  if (!found) found = manifold.nearest(c.arm_i);
  c.gap = found ? found->gap : std::numeric_limits<double>::infinity();
  if (!found) return c;
  c.normal = manifold.normal;
  const ContactType most = within((gap_limit + error) * diameter).type;
  if (c.type != within((gap_limit - error) * diameter).type) c.type = most;
  c.arm_i = found->arm;
  c.arm_j = found->arm - r;
  return c;
}

}  // namespace

template <int Dim>
RigidGeometry<Dim> rigid_geometry(const Packing<Dim>& packing, double gap_limit, double error) {
  RigidGeometry<Dim> out;
  for (const Contact<Dim>& c : packing.contacts)
    out.recorded.push_back(relocated(packing, c, gap_limit, error));
  for (const Contact<Dim>& c : ContactPoints<Dim>().find(packing, 0.0)) {
    const double overlap = -c.gap / (2.0 * smaller_radius(packing, c));
    out.deepest = std::max(out.deepest, overlap);
    if (overlap > std::max(gap_limit, error)) out.overlapping.push_back(c);
  }
  std::ranges::stable_sort(out.overlapping, [&](const Contact<Dim>& c, const Contact<Dim>& d) {
    return c.gap / (2.0 * smaller_radius(packing, c)) < d.gap / (2.0 * smaller_radius(packing, d));
  });
  return out;
}

#define FLOC_INSTANTIATE(Dim) template RigidGeometry<Dim> rigid_geometry(const Packing<Dim>&, double, double);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
