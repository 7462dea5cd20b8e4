#include "floc/packing/least_mechanisms.h"

#include <algorithm>
#include <vector>

namespace floc {
namespace {

/// Removes grains with fewer than two contacts, and the contacts of these grains, until all remaining grains have two
/// contacts or more. Returns, for each grain, whether it has remained.
template <int Dim>
std::vector<bool> held_grains(const Packing<Dim>& packing) {
  std::vector<bool> held(packing.grains.size(), true);
  for (bool removed = true; removed;) {
    removed = false;
    std::vector<int> degree(held.size(), 0);
    for (const Contact<Dim>& c : packing.contacts) {
      const bool on_wall = packing.is_wall(c.j);
      if (!held[c.i] || (!on_wall && !held[c.j])) continue;
      ++degree[c.i];
      if (!on_wall) ++degree[c.j];
    }
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i] && degree[i] < 2) held[i] = false, removed = true;
  }
  return held;
}

/// Number of contacts of one grain, and the kinds of springs in these contacts.
struct Hold {
  int n_contacts = 0;
  bool across = false;   ///< whether any contact has a tangential spring
  bool rolling = false;  ///< whether any contact has a rolling or twisting spring
};

/// Returns how many rotations of a grain the normal forces of its contacts may resist.
template <int Dim>
int rotations_of_shape(const Grains<Dim>& grains, int i) {
  if (grains.are_round() || grains.placed(i).shape->is_round()) return 0;
  const bool turns_about_axis = Dim == 3 && grains.placed(i).shape->n_vertices() == 2;
  return kRotations<Dim> - (turns_about_axis ? 1 : 0);
}

/// Returns the number of rotations of a grain that count as unknowns, since its contacts may resist them.
template <int Dim>
int rotations_of(const Grains<Dim>& grains, int i, const Hold& hold) {
  if (!hold.across && !hold.rolling) return rotations_of_shape(grains, i);
  const bool pivots = Dim == 3 && hold.n_contacts == 2 && !hold.rolling;
  return kRotations<Dim> - (pivots ? 1 : 0);
}

}  // namespace

template <int Dim>
int least_mechanisms(const Packing<Dim>& packing) {
  const std::vector<bool> held = held_grains(packing);
  std::vector<Hold> hold(held.size());
  int n_springs = 0;
  for (const Contact<Dim>& c : packing.contacts) {
    const bool on_wall = packing.is_wall(c.j);
    if (!held[c.i] || (!on_wall && !held[c.j])) continue;
    n_springs += 1 + (c.kt > 0.0 ? Dim - 1 : 0) + (c.kr > 0.0 ? Dim - 1 : 0) + (c.ktw > 0.0 ? 1 : 0);
    for (const int body : {c.i, c.j}) {
      if (packing.is_wall(body)) continue;
      ++hold[body].n_contacts;
      hold[body].across = hold[body].across || c.kt > 0.0;
      hold[body].rolling = hold[body].rolling || c.kr > 0.0 || c.ktw > 0.0;
    }
  }
  int n_unknowns = 0;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) n_unknowns += Dim + rotations_of(packing.grains, static_cast<int>(i), hold[i]);
  return std::max(n_unknowns - n_springs, 0);
}

template int least_mechanisms(const Packing<2>&);
template int least_mechanisms(const Packing<3>&);

}  // namespace floc
