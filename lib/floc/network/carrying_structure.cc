#include "floc/network/carrying_structure.h"

#include <algorithm>
#include <cmath>

namespace floc {

template <int Dim>
int least_contacts(const Packing<Dim>& packing) {
  const bool tangential = std::any_of(packing.contacts.begin(), packing.contacts.end(),
                                      [](const Contact<Dim>& c) { return !c.shear_force.isZero(0.0); });
  return tangential ? 2 : Dim + 1;
}

template <int Dim>
CarryingStructure carrying_structure(const Packing<Dim>& packing, double smallest_force, int least) {
  require_in_range("smallest_force", smallest_force, kNotNegativeNumber);
  require_in_range("least_contacts", least, kLeastContacts);
  CarryingStructure out;
  out.rattler.assign(packing.grains.size(), false);
  for (std::size_t k = 0; k < packing.contacts.size(); ++k)
    if (std::abs(packing.contacts[k].normal_force) > smallest_force)
      out.contacts.push_back(static_cast<int>(k));
  for (bool removed = true; removed;) {
    removed = false;
    out.degree.assign(out.rattler.size(), 0);
    for (const int k : out.contacts)
      for (const int body : {packing.contacts[k].i, packing.contacts[k].j})
        if (!packing.is_wall(body)) ++out.degree[body];
    for (std::size_t i = 0; i < out.rattler.size(); ++i)
      if (!out.rattler[i] && out.degree[i] < least) out.rattler[i] = removed = true;
    std::erase_if(out.contacts, [&](int k) {
      const Contact<Dim>& contact = packing.contacts[k];
      return out.rattler[contact.i] || (!packing.is_wall(contact.j) && out.rattler[contact.j]);
    });
  }
  out.n_rattlers = static_cast<int>(std::count(out.rattler.begin(), out.rattler.end(), true));
  return out;
}

template <int Dim>
ContactNetwork<Dim> carrying_network(const Packing<Dim>& packing, const CarryingStructure& carrying) {
  ContactNetwork<Dim> network = contact_network(packing);
  std::erase_if(network.contacts, [&](const NetworkContact<Dim>& c) {
    return !std::binary_search(carrying.contacts.begin(), carrying.contacts.end(), c.source);
  });
  return network;
}

#define FLOC_INSTANTIATE(Dim)                                                      \
  template int least_contacts(const Packing<Dim>&);                                \
  template CarryingStructure carrying_structure(const Packing<Dim>&, double, int); \
  template ContactNetwork<Dim> carrying_network(const Packing<Dim>&, const CarryingStructure&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
