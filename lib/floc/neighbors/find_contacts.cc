#include "floc/neighbors/find_contacts.h"

#include <algorithm>
#include <string>

#include "floc/base/error.h"
#include "floc/neighbors/interacting_pairs.h"
#include "floc/neighbors/spread_liquid.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/law/contact_forces.h"

namespace floc {
namespace {

/// A packing of n grains may have at most kContactsAlways + n * kContactsPerGrain contacts.
constexpr std::size_t kContactsAlways = 10'000;
constexpr std::size_t kContactsPerGrain = 100;

}  // namespace

template <int Dim>
std::vector<NeighborPair<Dim>> interacting_pairs(const Packing<Dim>& packing) {
  const double range = packing.law.range();
  const double reach = largest_diameter(packing.grains) + range;
  std::vector<NeighborPair<Dim>> pairs =
      find_pairs(search_cell(packing.cell, packing.walls, reach), packing.grains, range);
  if (packing.walls.empty()) return pairs;
  for (NeighborPair<Dim> pair : find_wall_pairs(packing.walls, packing.grains, packing.wall_law.range())) {
    pair.j += packing.grains.size();
    pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end(), precedes<NeighborPair<Dim>>);
  return pairs;
}

template <int Dim>
void find_contacts(Packing<Dim>& packing) {
  packing.contacts.clear();
  const std::vector<NeighborPair<Dim>> pairs = interacting_pairs(packing);
  // More contacts than this limit indicate a wrong radius or a wrong cell. The number is tested before memory is
  // allocated for the contacts.
  if (pairs.size() > kContactsAlways + kContactsPerGrain * static_cast<std::size_t>(packing.grains.size()))
    throw InputError(
        "cell", "the grains overlap so much, or attract each other across such wide gaps, that there are " +
                    std::to_string(pairs.size()) + " contacts of " + std::to_string(packing.grains.size()) +
                    " grains: a radius or the cell is wrong");
  packing.contacts.reserve(pairs.size());
  for (const NeighborPair<Dim>& pair : pairs) {
    Contact<Dim> contact;
    contact.i = pair.i;
    contact.j = pair.j;
    contact.image = pair.image;
    packing.contacts.push_back(contact);
  }
  // interacting_pairs() does not find all pairs with a liquid bridge: the range of a contact law does not include the
  // gaps across which bridges act, because these gaps depend on the volumes of the bridges. spread_liquid() adds the
  // missing pairs.
  refresh_contacts(packing);
  spread_liquid(packing);
  // Two kinds of contact are errors. If the centre of a grain is beyond a wall, the normal of the contact points from
  // the wall into the box. If two grains have the same centre, the normal of the contact is zero.
  const auto name = [&](int i) { return std::to_string(packing.grains.name(i)); };
  for (const Contact<Dim>& c : packing.contacts) {
    if (packing.is_wall(c.j) && c.normal.dot(packing.wall(c.j).normal()) <= 0.0)
      throw InputError("grain " + name(c.i), "the grain has its centre on or beyond a wall");
    if (c.normal.isZero(0.0))
      throw InputError("grains " + name(c.i) + " and " + name(c.j),
                       "the grains have the same centre: their contact has no direction");
  }
}

template std::vector<NeighborPair<2>> interacting_pairs(const Packing<2>&);
template std::vector<NeighborPair<3>> interacting_pairs(const Packing<3>&);
template void find_contacts(Packing<2>&);
template void find_contacts(Packing<3>&);

}  // namespace floc
