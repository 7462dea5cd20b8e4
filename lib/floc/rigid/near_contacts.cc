#include "floc/rigid/near_contacts.h"

#include <algorithm>
#include <vector>

#include "floc/neighbors/pairs.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/locate.h"

namespace floc {

template <int Dim>
int add_near_contacts(Packing<Dim>& packing, double gap) {
  std::vector<NeighborPair<Dim>> pairs =
      find_pairs(search_cell(packing.cell, packing.walls, gap), packing.grains, gap);
  for (NeighborPair<Dim> pair : find_wall_pairs(packing.walls, packing.grains, gap)) {
    pair.j += packing.grains.size();
    pairs.push_back(pair);
  }
  const std::size_t before = packing.contacts.size();
  for (const NeighborPair<Dim>& pair : pairs) {
    Contact<Dim> contact;
    contact.i = pair.i;
    contact.j = pair.j;
    contact.image = pair.image;
    const auto known = packing.contacts.begin() + static_cast<std::ptrdiff_t>(before);
    const auto same = std::lower_bound(packing.contacts.begin(), known, contact, precedes<Contact<Dim>>);
    if (same != known && !precedes(contact, *same)) continue;
    place(locate(packing, contact), contact);
    packing.contacts.push_back(contact);
  }
  std::ranges::sort(packing.contacts, precedes<Contact<Dim>>);
  return static_cast<int>(packing.contacts.size() - before);
}

template int add_near_contacts(Packing<2>&, double);
template int add_near_contacts(Packing<3>&, double);

}  // namespace floc
