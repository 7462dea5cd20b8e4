#include "floc/packing/liquid/liquid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "floc/contact/adhesion/capillary_adhesion.h"
#include "floc/contact/history.h"
#include "floc/packing/grain_sizes.h"

namespace floc {

LiquidShares share_liquid(const CapillaryAdhesion& bridges, double liquid,
                          std::span<const BridgeablePair> pairs) {
  const double per_volume = bridges.reach(1.0);  // 1 + th/2 with the contact angle th
  std::vector<double> q(pairs.size());
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const double reaching = pairs[p].gap / per_volume;
    q[p] = pairs[p].gap > 0.0 ? pairs[p].radius / (reaching * reaching * reaching)
                              : std::numeric_limits<double>::infinity();
  }
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&q](std::size_t a, std::size_t b) { return q[a] > q[b]; });
  LiquidShares shares;
  for (const std::size_t p : order) {
    const double sum = shares.radius_sum + pairs[p].radius;
    if (!(sum <= liquid * q[p])) break;
    shares.radius_sum = sum;
    ++shares.n_bonds;
  }
  shares.volume.assign(pairs.size(), 0.0);
  for (int k = 0; k < shares.n_bonds; ++k)
    shares.volume[order[k]] = liquid * (pairs[order[k]].radius / shares.radius_sum);
  return shares;
}

bool may_hold_liquid(const CapillaryAdhesion& bridges, double gap, double volume) {
  return bridges.formation == BridgeFormation::gap || gap <= 0.0 || volume > 0.0;
}

double volume_of_spheres(std::span<const double> radius) {
  double sum = 0.0;
  for (const double r : radius) sum += r * r * r;
  return 4.0 / 3.0 * std::numbers::pi * sum;
}

BridgeSearch::BridgeSearch(const CapillaryAdhesion& bridges, std::span<const double> radius)
    : bridges_(bridges),
      liquid_(bridges.liquid_volume(volume_of_spheres(radius))),
      largest_radius_(radius.empty() ? 0.0 : *std::max_element(radius.begin(), radius.end())),
      radius_sum_(kBridgesPerGrain * std::accumulate(radius.begin(), radius.end(), 0.0)) {}

double BridgeSearch::first_reach() const {
  return radius_sum_ > 0.0 ? bridges_.reach(liquid_ * (largest_radius_ / radius_sum_)) : 0.0;
}

/// The bound is the reach of a bridge between two grains of the largest radius, because this bridge has the largest
/// volume. If more bridges form, the volume of each bridge decreases. If there is only one bridge, it contains all the
/// liquid.
double BridgeSearch::reach_bound(const LiquidShares& shares) const {
  return bridges_.reach(liquid_ *
                        std::min(1.0, shares.n_bonds > 0 ? largest_radius_ / shares.radius_sum : 1.0));
}

double BridgeSearch::wider(double reach, const LiquidShares& shares) const {
  const double bound = reach_bound(shares);
  return bound <= reach ? reach : std::min(bound, 2.0 * reach);
}

template <int Dim>
double bridge_volume(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return holds_liquid(packing) ? contact.history[HistoryLayout<Dim>::kAdhesion] : 0.0;
}

template <int Dim>
void set_bridge_volume(double volume, Contact<Dim>& contact) {
  contact.history[HistoryLayout<Dim>::kAdhesion] = volume;
}

namespace {

/// Returns the radius of the larger grain of a contact.
template <int Dim>
double largest_radius(const Packing<Dim>& packing, const Contact<Dim>& c) {
  return std::max(packing.grains.radius[c.i], packing.surface_radius(c.j));
}

}  // namespace

template <int Dim>
double range_of(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  if (const CapillaryAdhesion* bridges = packing.law.liquid())
    return bridges->reach(std::max(bridge_volume(packing, contact), 0.0));
  const Law& law = packing.is_wall(contact.j) ? packing.wall_law : packing.law;
  return law.reach(largest_radius(packing, contact));
}

template <int Dim>
double interaction_range(const Packing<Dim>& packing) {
  double range = packing.law.reach(0.5 * largest_diameter(packing.grains));
  if (holds_liquid(packing))
    for (const Contact<Dim>& c : packing.contacts)
      if (bridge_volume(packing, c) != 0.0) range = std::max({range, range_of(packing, c), c.gap});
  return range;
}

template <int Dim>
double pull_off_force(const Packing<Dim>& packing) {
  return packing.law.pull_off_force(0.5 * largest_diameter(packing.grains));
}

template <int Dim>
double pull_off_force(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  const double radius = packing.grains.radius[contact.i];
  if (packing.is_wall(contact.j)) return packing.wall_law.pull_off_force(PairGeometry<>(0.0, radius));
  const CapillaryAdhesion* bridges = packing.law.liquid();
  if (!bridges)
    return packing.law.pull_off_force(PairGeometry<>(0.0, reduced(radius, packing.grains.radius[contact.j])));
  if (!(bridge_volume(packing, contact) > 0.0)) return 0.0;
  return bridges->strength(radius, packing.grains.radius[contact.j]);
}

#define FLOC_INSTANTIATE(Dim)                                              \
  template double bridge_volume(const Packing<Dim>&, const Contact<Dim>&); \
  template void set_bridge_volume(double, Contact<Dim>&);                  \
  template double range_of(const Packing<Dim>&, const Contact<Dim>&);      \
  template double interaction_range(const Packing<Dim>&);                  \
  template double pull_off_force(const Packing<Dim>&);                     \
  template double pull_off_force(const Packing<Dim>&, const Contact<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
