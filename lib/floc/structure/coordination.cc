#include "floc/structure/coordination.h"

#include <algorithm>
#include <cmath>

#include "floc/base/range.h"
#include "floc/network/rattlers.h"
#include "floc/packing/contact_order.h"

namespace floc {
namespace {

/// Counts the contacts whose two grains each have exactly two contacts.
template <int Dim>
int between_pairs(const Packing<Dim>& packing) {
  std::vector<int> degree(packing.grains.size(), 0);
  for (const Contact<Dim>& c : packing.contacts)
    if (!c.distant && !packing.is_wall(c.j))
      for (const int grain : {c.i, c.j}) ++degree[grain];
  int n = 0;
  for (const Contact<Dim>& c : packing.contacts)
    n += !c.distant && !packing.is_wall(c.j) && degree[c.i] == 2 && degree[c.j] == 2;
  return n;
}

}  // namespace

template <int Dim>
Coordination coordination(const Packing<Dim>& packing, double zero_force) {
  require_in_range("zero_force", zero_force, kNotNegativeNumber);
  Coordination result;
  int positive = 0, negative = 0;
  // The coordination number z counts pairs of grains that touch. Pairs that attract each other across a gap do not
  // count, in contrast to [GRC2008] (docs/physics.md, "Coordination and rattlers"). Contacts with walls matter only in
  // the search for rattlers.
  for (const Contact<Dim>& c : packing.contacts) {
    if (packing.is_wall(c.j)) continue;
    if (c.distant) {
      ++result.n_distant;
      continue;
    }
    ++result.n_contacts;
    positive += c.normal_force > zero_force;
    negative += c.normal_force < -zero_force;
  }
  const int n = packing.grains.size();
  if (n == 0) return result;
  const double per_contact = 2.0 / n;
  result.z = per_contact * result.n_contacts;
  result.z_plus = per_contact * positive;
  result.z_minus = per_contact * negative;
  result.z_zero = per_contact * (result.n_contacts - positive - negative);
  const std::vector<bool> rattler = find_rattlers(packing, zero_force);
  result.n_rattlers = static_cast<int>(std::count(rattler.begin(), rattler.end(), true));
  result.rattler_fraction = static_cast<double>(result.n_rattlers) / n;
  // The coordination number z* counts grains that are not rattlers, and contacts between two of these grains.
  int n_held = 0;
  for (const Contact<Dim>& c : packing.contacts)
    n_held += !c.distant && !packing.is_wall(c.j) && !rattler[c.i] && !rattler[c.j];
  if (result.n_rattlers < n) result.z_star = 2.0 * n_held / (n - result.n_rattlers);
  if (result.n_contacts > 0) result.x22 = static_cast<double>(between_pairs(packing)) / result.n_contacts;
  return result;
}

template <int Dim>
std::int64_t n_touching_pairs(const Packing<Dim>& packing) {
  std::int64_t n = 0;
  const Contact<Dim>* last = nullptr;
  for (const Contact<Dim>& c : packing.contacts) {
    if (packing.is_wall(c.j)) continue;
    n += !last || !same_pair(*last, c);
    last = &c;
  }
  return n;
}

template Coordination coordination(const Packing<2>&, double);
template Coordination coordination(const Packing<3>&, double);
template std::int64_t n_touching_pairs(const Packing<2>&);
template std::int64_t n_touching_pairs(const Packing<3>&);

}  // namespace floc
