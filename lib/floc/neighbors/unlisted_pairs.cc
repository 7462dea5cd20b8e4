#include "floc/neighbors/unlisted_pairs.h"

#include <algorithm>
#include <numeric>

#include "floc/packing/contact_order.h"

namespace floc {
namespace {

template <int Dim>
NeighborPair<Dim> canonical_pair(const Contact<Dim>& c) {
  return canonical(NeighborPair<Dim>{c.i, c.j, c.image});
}

/// Returns the indices of the contacts, sorted by the canonical form (i <= j) of the pair of each contact. Contacts
/// usually have this order already; only those read from a file may have another order. The function sorts indices,
/// which is cheaper than sorting contacts, because there may be millions of contacts.
template <int Dim>
std::vector<int> canonical_order(const std::vector<Contact<Dim>>& contacts) {
  std::vector<int> order(contacts.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](int a, int b) {
    return precedes(canonical_pair(contacts[a]), canonical_pair(contacts[b]));
  };
  if (!std::is_sorted(order.begin(), order.end(), before)) std::sort(order.begin(), order.end(), before);
  return order;
}

}  // namespace

template <int Dim>
std::vector<Contact<Dim>> unlisted_pairs(const Packing<Dim>& packing,
                                         const std::vector<NeighborPair<Dim>>& pairs) {
  const std::vector<int> order = canonical_order(packing.contacts);
  auto next = order.begin();
  std::vector<Contact<Dim>> unlisted;
  for (const NeighborPair<Dim>& pair : pairs) {
    while (next != order.end() && precedes(canonical_pair(packing.contacts[*next]), pair)) ++next;
    if (next != order.end() && canonical_pair(packing.contacts[*next]) == pair) continue;
    Contact<Dim>& c = unlisted.emplace_back();
    c.i = pair.i;
    c.j = pair.j;
    c.image = pair.image;
  }
  return unlisted;
}

template std::vector<Contact<2>> unlisted_pairs(const Packing<2>&, const std::vector<NeighborPair<2>>&);
template std::vector<Contact<3>> unlisted_pairs(const Packing<3>&, const std::vector<NeighborPair<3>>&);

}  // namespace floc
