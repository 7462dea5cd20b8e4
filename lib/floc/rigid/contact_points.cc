#include "floc/rigid/contact_points.h"

#include <algorithm>
#include <limits>

#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/locate.h"
#include "floc/shape/point_memory.h"

namespace floc {
namespace {

/// Two contact points with different keys, an earlier point and a new point, are matched only if their distance,
/// divided by the smaller radius, is at most this number.
constexpr double kMatchingShare = 0.25;

template <int Dim>
void append(const Manifold<Dim>& manifold, Contact<Dim> contact, const Vec<Dim>& branch,
            std::vector<Contact<Dim>>& out) {
  contact.normal = manifold.normal;
  contact.type = manifold.type;
  for (const ManifoldPoint<Dim>& point : manifold.points) {
    contact.key = static_cast<int>(point.key);
    contact.gap = point.gap;
    contact.arm_i = point.arm;
    contact.arm_j = point.arm - branch;
    out.push_back(contact);
  }
}

template <int Dim>
Contact<Dim> contact_of(const NeighborPair<Dim>& pair) {
  Contact<Dim> contact;
  contact.i = pair.i;
  contact.j = pair.j;
  contact.image = pair.image;
  return contact;
}

template <int Dim>
void take_forces(const Contact<Dim>& from, Contact<Dim>& to) {
  to.normal_force = from.normal_force;
  to.elastic_force = from.elastic_force;
  to.shear_force = from.shear_force - from.shear_force.dot(to.normal) * to.normal;
  to.sliding = from.sliding;
}

template <int Dim>
std::vector<ManifoldPoint<Dim>> points_of(std::span<const Contact<Dim>> contacts) {
  std::vector<ManifoldPoint<Dim>> points;
  for (const Contact<Dim>& c : contacts) points.push_back({c.arm_i, c.gap, static_cast<std::uint32_t>(c.key)});
  return points;
}

}  // namespace

template <int Dim>
std::vector<Contact<Dim>> ContactPoints<Dim>::find(const Packing<Dim>& packing, double reach) {
  return find(packing, reach, std::numeric_limits<double>::infinity());
}

template <int Dim>
std::vector<Contact<Dim>> ContactPoints<Dim>::find_touching(const Packing<Dim>& packing, double share) {
  const std::vector<double>& radius = packing.grains.radius;
  return find(packing, share * 2.0 * *std::max_element(radius.begin(), radius.end()), share);
}

/// Returns the contact points whose gap is smaller than both `reach` (length) and `share` times the smaller diameter.
template <int Dim>
std::vector<Contact<Dim>> ContactPoints<Dim>::find(const Packing<Dim>& packing, double reach, double share) {
  const Grains<Dim>& grains = packing.grains;
  std::vector<Contact<Dim>> out;
  const auto add_points = [&](Contact<Dim> contact, AxisFeatures* features) {
    const double own_reach = std::min(reach, share * 2.0 * smaller_radius(packing, contact));
    if (grains.are_round()) {
      place(locate(packing, contact), contact);
      if (contact.gap < own_reach) out.push_back(contact);
    } else {
      const Vec<Dim> r = branch(packing, contact);
      append(manifold_of(packing, contact, r, own_reach, features), contact, r, out);
    }
  };
  // The pairs of the last search and the new pairs are both sorted by (i, j, image). One simultaneous pass through both
  // lists therefore finds the stored features of each pair. A new pair begins with default features.
  std::vector<KnownPair> known;
  std::size_t next = 0;
  const double furthest = largest_diameter(grains) + reach;
  for (const NeighborPair<Dim>& pair :
       find_pairs(search_cell(packing.cell, packing.walls, furthest), grains, reach)) {
    while (next < known_.size() && precedes(known_[next].pair, pair)) ++next;
    KnownPair now{pair, {}};
    if (next < known_.size() && !precedes(pair, known_[next].pair)) now.features = known_[next].features;
    add_points(contact_of(pair), &now.features);
    if (!grains.are_round()) known.push_back(now);
  }
  known_ = std::move(known);
  // The separating axis of a grain and a wall is always the normal of the wall, so no features are stored for walls.
  // The pairs with walls come after all pairs of grains. The contacts are therefore sorted at the end.
  for (NeighborPair<Dim> pair : find_wall_pairs(packing.walls, grains, reach)) {
    pair.j += grains.size();
    add_points(contact_of(pair), nullptr);
  }
  std::sort(out.begin(), out.end(), precedes<Contact<Dim>>);
  return out;
}

template <int Dim>
void carry_forces(const Packing<Dim>& packing, const std::vector<Contact<Dim>>& before,
                  std::vector<Contact<Dim>>& now) {
  std::size_t old = 0;
  for (std::size_t first = 0, last; first < now.size(); first = last) {
    last = first;
    while (last < now.size() && same_pair(now[first], now[last])) ++last;
    Contact<Dim> lowest = now[first];
    lowest.key = std::numeric_limits<int>::min();
    while (old < before.size() && precedes(before[old], lowest)) ++old;
    std::size_t end = old;
    while (end < before.size() && same_pair(before[end], now[first])) ++end;
    if (end == old) continue;
    const double radius = smaller_radius(packing, now[first]);
    const std::vector<int> match =
        matched_points<Dim>(points_of<Dim>(std::span(now).subspan(first, last - first)),
                            points_of<Dim>(std::span(before).subspan(old, end - old)), kMatchingShare * radius);
    for (std::size_t k = first; k < last; ++k)
      if (match[k - first] >= 0) take_forces(before[old + static_cast<std::size_t>(match[k - first])], now[k]);
    old = end;
  }
}

template <int Dim>
double default_gap_tolerance(const Packing<Dim>& packing) {
  if (packing.grains.are_round()) return 1e-4;
  return are_smooth_polyhedra(packing) ? 1e-6 : 1e-3;
}

template class ContactPoints<2>;
template class ContactPoints<3>;
template double default_gap_tolerance(const Packing<2>&);
template double default_gap_tolerance(const Packing<3>&);
template void carry_forces(const Packing<2>&, const std::vector<Contact<2>>&, std::vector<Contact<2>>&);
template void carry_forces(const Packing<3>&, const std::vector<Contact<3>>&, std::vector<Contact<3>>&);

}  // namespace floc
