#include "floc/neighbors/spread_liquid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "floc/contact/adhesion/capillary_adhesion.h"
#include "floc/neighbors/pairs.h"
#include "floc/neighbors/unlisted_pairs.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/locate.h"

namespace floc {
namespace {

/// Returns the pairs of grains that may get liquid, as sorted contacts whose gaps are set. The pairs are the contacts
/// between grains in the packing, and all other pairs of grains whose gap is below `reach` (length). The springs of the
/// other pairs are unloaded.
template <int Dim>
std::vector<Contact<Dim>> candidates(const Packing<Dim>& packing, double reach) {
  std::vector<Contact<Dim>> found;
  for (const Contact<Dim>& c : packing.contacts)
    if (!packing.is_wall(c.j)) found.push_back(c);
  const Cell<Dim> cell = search_cell(packing.cell, packing.walls, largest_diameter(packing.grains) + reach);
  const std::vector<Contact<Dim>> others = unlisted_pairs(packing, find_pairs(cell, packing.grains, reach));
  found.insert(found.end(), others.begin(), others.end());
  std::sort(found.begin(), found.end(), precedes<Contact<Dim>>);
  for (Contact<Dim>& c : found) place(locate(packing, c), c);
  return found;
}

/// Distributes the liquid of the packing over those contacts in `found` that may have a liquid bridge.
/// @return the volume of liquid that each contact in `found` gets
template <int Dim>
LiquidShares shares_over(const Packing<Dim>& packing, const BridgeSearch& search,
                         const std::vector<Contact<Dim>>& found) {
  const CapillaryAdhesion& bridges = *packing.law.liquid();
  const std::vector<double>& radius = packing.grains.radius;
  return share_liquid_among(bridges, search.liquid(), static_cast<int>(found.size()),
                            [&](int k) -> std::optional<BridgeablePair> {
                              const Contact<Dim>& c = found[k];
                              if (!may_hold_liquid(bridges, c.gap, bridge_volume(packing, c))) return {};
                              return BridgeablePair{c.gap, 2.0 * reduced(radius[c.i], radius[c.j])};
                            });
}

}  // namespace

template <int Dim>
LiquidChange spread_liquid(Packing<Dim>& packing) {
  LiquidChange change;
  if (!holds_liquid(packing)) return change;
  const CapillaryAdhesion& bridges = *packing.law.liquid();
  const BridgeSearch search(bridges, packing.grains.radius);
  const bool on_contact = bridges.formation == BridgeFormation::contact;
  double reach = on_contact ? 0.0 : search.first_reach();
  std::vector<Contact<Dim>> found = candidates(packing, reach);
  LiquidShares shares = shares_over(packing, search, found);
  // If bridges form only on contact, every pair that gets liquid touches or is already a contact of the packing. The
  // search for pairs is then not widened.
  for (double wider = search.wider(reach, shares); !on_contact && wider > reach;
       wider = search.wider(reach, shares)) {
    reach = wider;
    found = candidates(packing, reach);
    shares = shares_over(packing, search, found);
  }
  std::vector<Contact<Dim>> contacts;
  for (const Contact<Dim>& c : packing.contacts)
    if (packing.is_wall(c.j)) contacts.push_back(c);
  for (std::size_t k = 0; k < found.size(); ++k) {
    Contact<Dim>& c = found[k];
    const double before = bridge_volume(packing, c), volume = shares.volume[k];
    change.n_formed += before == 0.0 && volume > 0.0;
    change.n_broken += before != 0.0 && volume == 0.0;
    if (before != 0.0) change.largest = std::max(change.largest, std::abs(volume / before - 1.0));
    set_bridge_volume(volume, c);
    c.distant = !touches(packing, c);
    if (interacts(packing, c)) contacts.push_back(c);
  }
  packing.contacts = std::move(contacts);
  std::sort(packing.contacts.begin(), packing.contacts.end(), precedes<Contact<Dim>>);
  refresh_contacts(packing);
  return change;
}

template LiquidChange spread_liquid(Packing<2>&);
template LiquidChange spread_liquid(Packing<3>&);

}  // namespace floc
