#include "floc/assembly/saved_start.h"

#include <utility>

#include "floc/neighbors/find_contacts.h"
#include "floc/packing/contact_forces.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/tile.h"

namespace floc {

template <int Dim>
Packing<Dim> start_from(Packing<Dim> saved, const LawParameters& law, const Vec<Dim, int>& copies) {
  Grains<Dim>& g = saved.grains;
  for (Vec<Dim>& v : g.velocity) v.setZero();
  for (RotationVector<Dim>& w : g.angular_velocity) w.setZero();
  saved.cell.velocity.setZero();
  saved.law = law;
  const std::vector<Contact<Dim>> before = std::move(saved.contacts);
  find_contacts(saved);
  auto old = before.begin();
  for (Contact<Dim>& c : saved.contacts) {
    while (old != before.end() && precedes(*old, c)) ++old;
    if (old == before.end() || precedes(c, *old)) continue;
    c.memory = old->memory;
  }
  refresh_contacts(saved);
  return copies.prod() == 1 ? saved : tiled(saved, copies);
}

template Packing<2> start_from(Packing<2>, const LawParameters&, const Vec<2, int>&);
template Packing<3> start_from(Packing<3>, const LawParameters&, const Vec<3, int>&);

}  // namespace floc
