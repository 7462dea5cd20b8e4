#include "floc/network/rattlers.h"

#include <algorithm>

#include "floc/base/range.h"
#include "floc/packing/bonds.h"

namespace floc {
namespace {

template <int Dim>
bool carries_force(const Packing<Dim>& packing, double smallest_force) {
  return std::any_of(packing.contacts.begin(), packing.contacts.end(),
                     [&](const Contact<Dim>& c) { return c.normal_force > smallest_force; });
}

/// Makes one pass through the grains. Marks a grain as a rattler if its contacts with walls and with unmarked grains do
/// not keep it in place.
/// @return whether a grain was marked
template <int Dim>
bool remove_unheld(const Packing<Dim>& packing, double smallest_force, std::vector<bool>& rattler) {
  const int n = packing.grains.size();
  std::vector<int> n_touching(n, 0);
  std::vector<bool> loaded(n, false);
  for (const Contact<Dim>& c : packing.contacts) {
    const bool on_wall = packing.is_wall(c.j);
    if (rattler[c.i] || (!on_wall && rattler[c.j])) continue;
    for (const int grain : {c.i, c.j}) {
      if (packing.is_wall(grain)) continue;
      ++n_touching[grain];
      if (c.normal_force > smallest_force) loaded[grain] = true;
    }
  }
  bool removed = false;
  for (int i = 0; i < n; ++i)
    if (!rattler[i] && (!loaded[i] || n_touching[i] < 2)) rattler[i] = removed = true;
  return removed;
}

}  // namespace

template <int Dim>
std::vector<bool> find_rattlers(const Packing<Dim>& packing, double smallest_force) {
  require_in_range("smallest_force", smallest_force, kNotNegativeNumber);
  const bool cohesive = packing.law.adheres() || has_bonds(packing);
  if (cohesive || !carries_force(packing, smallest_force)) {
    std::vector<bool> alone(packing.grains.size(), true);
    for (const Contact<Dim>& c : packing.contacts) {
      alone[c.i] = false;
      if (!packing.is_wall(c.j)) alone[c.j] = false;
    }
    return alone;
  }
  std::vector<bool> rattler(packing.grains.size(), false);
  while (remove_unheld(packing, smallest_force, rattler)) {
  }
  return rattler;
}

template std::vector<bool> find_rattlers(const Packing<2>&, double);
template std::vector<bool> find_rattlers(const Packing<3>&, double);

}  // namespace floc
