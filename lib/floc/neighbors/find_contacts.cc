#include "floc/neighbors/find_contacts.h"

#include "floc/neighbors/pairs.h"
#include "floc/packing/contact_forces.h"

namespace floc {

template <int Dim>
void find_contacts(Packing<Dim>& packing) {
  packing.contacts.clear();
  for (const NeighborPair<Dim>& pair : find_pairs(packing.cell, packing.grains, packing.law.range())) {
    Contact<Dim> contact;
    contact.i = pair.i;
    contact.j = pair.j;
    contact.image = pair.image;
    packing.contacts.push_back(contact);
  }
  refresh_contacts(packing);
}

template void find_contacts(Packing<2>&);
template void find_contacts(Packing<3>&);

}  // namespace floc
