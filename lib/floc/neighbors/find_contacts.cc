#include "floc/neighbors/find_contacts.h"

#include <string>

#include "floc/base/error.h"
#include "floc/neighbors/pairs.h"
#include "floc/packing/contact_forces.h"

namespace floc {
namespace {

/// Contacts that a packing may have, and more for each of its grains.
constexpr std::size_t kContactsAlways = 10'000;
constexpr std::size_t kContactsPerGrain = 100;

}  // namespace

template <int Dim>
void find_contacts(Packing<Dim>& packing) {
  packing.contacts.clear();
  const std::vector<NeighborPair<Dim>> pairs = find_pairs(packing.cell, packing.grains, packing.law.range());
  if (pairs.size() > kContactsAlways + kContactsPerGrain * static_cast<std::size_t>(packing.grains.size()))
    throw InputError("cell", "the grains overlap so much, or reach so far, that there are " +
                                 std::to_string(pairs.size()) + " contacts of " +
                                 std::to_string(packing.grains.size()) +
                                 " grains: a radius or the cell is wrong");
  for (const NeighborPair<Dim>& pair : pairs) {
    Contact<Dim> contact;
    contact.i = pair.i;
    contact.j = pair.j;
    contact.image = pair.image;
    packing.contacts.push_back(contact);
  }
  refresh_contacts(packing);
  for (const Contact<Dim>& c : packing.contacts)
    if (c.normal.isZero(0.0))
      throw InputError("grains " + std::to_string(c.i) + " and " + std::to_string(c.j),
                       "have the same centre: their contact has no direction");
}

template void find_contacts(Packing<2>&);
template void find_contacts(Packing<3>&);

}  // namespace floc
