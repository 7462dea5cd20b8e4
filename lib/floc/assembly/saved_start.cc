#include "floc/assembly/saved_start.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "floc/contact/history.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/tile.h"

namespace floc {

namespace {

/// Returns a mask for the numbers in the history of a contact: 1 for each number that both laws have, 0 for all other
/// numbers.
template <int Dim>
ContactHistory<Dim> common_history(const Law& before, const Law& after) {
  ContactHistory<Dim> common = ContactHistory<Dim>::Zero();
  for (const HistoryQuantity& p : history_quantities(before, Dim))
    for (const HistoryQuantity& q : history_quantities(after, Dim))
      if (std::string_view(p.declared.name) == q.declared.name && p.begin == q.begin)
        common.segment(q.begin, q.size).setOnes();
  return common;
}

/// Replaces the contact law of a packing of disks or spheres, and finds its contacts anew.
template <int Dim>
void replace_law(Packing<Dim>& saved, const Law& law) {
  const ContactHistory<Dim> kept = common_history<Dim>(saved.law, law);
  saved.law = law;
  const std::vector<Contact<Dim>> before = std::move(saved.contacts);
  find_contacts(saved);
  // Two grains that touched under the old law may still stick together, even if their gap is too wide for
  // find_contacts(). Contacts of this kind are kept.
  std::vector<Contact<Dim>> held;
  auto found = saved.contacts.begin();
  for (const Contact<Dim>& old : before) {
    while (found != saved.contacts.end() && precedes(*found, old)) ++found;
    if (found != saved.contacts.end() && !precedes(old, *found)) {
      found->history = old.history.cwiseProduct(kept);
      continue;
    }
    Contact<Dim> c = old;
    c.history = old.history.cwiseProduct(kept);
    if (touches(saved, c)) held.push_back(c);
  }
  saved.contacts.insert(saved.contacts.end(), held.begin(), held.end());
  std::sort(saved.contacts.begin(), saved.contacts.end(), precedes<Contact<Dim>>);
  refresh_contacts(saved);
}

/// Replaces the contact law of a packing of grains with shapes. The motion finds the contact points anew in its first
/// time step, and gives them the forces of the saved points.
template <int Dim>
void replace_law_of_shapes(Packing<Dim>& saved, const Law& law) {
  saved.law = law;
  for (Contact<Dim>& c : saved.contacts) c.normal_force = c.elastic_force - saved.law_of(c).pull_off_force();
}

}  // namespace

template <int Dim>
Packing<Dim> start_from(Packing<Dim> saved, const Law& law, const Vec<Dim, int>& copies) {
  stop_grains(saved);
  if (saved.grains.are_round())
    replace_law(saved, law);
  else
    replace_law_of_shapes(saved, law);
  return copies.prod() == 1 ? saved : tiled(saved, copies);
}

template Packing<2> start_from(Packing<2>, const Law&, const Vec<2, int>&);
template Packing<3> start_from(Packing<3>, const Law&, const Vec<3, int>&);

}  // namespace floc
