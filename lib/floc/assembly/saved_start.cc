#include "floc/assembly/saved_start.h"

#include <string_view>
#include <utility>

#include "floc/neighbors/find_contacts.h"
#include "floc/packing/contact_forces.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/tile.h"

namespace floc {

namespace {

/// 1 for each number that contacts remember under both laws, else 0.
template <int Dim>
ContactMemory<Dim> common_memory(const LawParameters& before, const LawParameters& after) {
  ContactMemory<Dim> common = ContactMemory<Dim>::Zero();
  for (const RememberedQuantity& p : remembered_quantities(before, Dim))
    for (const RememberedQuantity& q : remembered_quantities(after, Dim))
      if (std::string_view(p.declared.name) == q.declared.name && p.begin == q.begin)
        common.segment(q.begin, q.size).setOnes();
  return common;
}

}  // namespace

template <int Dim>
Packing<Dim> start_from(Packing<Dim> saved, const LawParameters& law, const Vec<Dim, int>& copies) {
  Grains<Dim>& g = saved.grains;
  for (Vec<Dim>& v : g.velocity) v.setZero();
  for (RotationVector<Dim>& w : g.angular_velocity) w.setZero();
  saved.cell.velocity.setZero();
  const ContactMemory<Dim> kept = common_memory<Dim>(saved.law, law);
  saved.law = law;
  const std::vector<Contact<Dim>> before = std::move(saved.contacts);
  find_contacts(saved);
  auto old = before.begin();
  for (Contact<Dim>& c : saved.contacts) {
    while (old != before.end() && precedes(*old, c)) ++old;
    if (old == before.end() || precedes(c, *old)) continue;
    c.memory = old->memory.cwiseProduct(kept);
  }
  refresh_contacts(saved);
  return copies.prod() == 1 ? saved : tiled(saved, copies);
}

template Packing<2> start_from(Packing<2>, const LawParameters&, const Vec<2, int>&);
template Packing<3> start_from(Packing<3>, const LawParameters&, const Vec<3, int>&);

}  // namespace floc
