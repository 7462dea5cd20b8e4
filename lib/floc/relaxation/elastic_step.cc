#include "floc/relaxation/elastic_step.h"

#include <cstddef>

#include "floc/contact/history.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/liquid/liquid.h"

namespace floc {
namespace {

/// Largest elongation of an undamped spring under a suddenly applied load, divided by its elongation in equilibrium.
constexpr double kOvershoot = 2.0;

template <class T>
T extrapolated(const T& start, const T& end) {
  return start + kOvershoot * (end - start);
}

/// Whether all springs of a contact stay below their caps on the straight path from one state to another and on an
/// equally long extension beyond the second state (kOvershoot).
/// @pre the surfaces touch
template <int Dim>
bool sticks(const Law& law, const Contact<Dim>& from, const Contact<Dim>& to) {
  Contact<Dim> beyond = to;
  beyond.elastic_force = extrapolated(from.elastic_force, to.elastic_force);
  beyond.history = extrapolated(from.history, to.history);
  return !mobilised(law, beyond, 0.0).any() && !to.is_mobilised();
}

/// Whether the history variables of the law of the normal force are equal in two states of a contact. If they are
/// equal, the law has dissipated no energy between the two states.
template <int Dim>
bool remembers_same_overlap(const Contact<Dim>& from, const Contact<Dim>& to) {
  constexpr int n = HistoryLayout<Dim>::kNormalRoom;
  return from.history.template segment<n>(HistoryLayout<Dim>::kNormal) ==
         to.history.template segment<n>(HistoryLayout<Dim>::kNormal);
}

}  // namespace

template <int Dim>
bool is_elastic_step(const Packing<Dim>& from, const Packing<Dim>& to) {
  if (from.contacts.size() != to.contacts.size()) return false;
  for (std::size_t k = 0; k < to.contacts.size(); ++k) {
    const Contact<Dim>&p = from.contacts[k], &q = to.contacts[k];
    if (p.i != q.i || p.j != q.j || p.image != q.image || p.distant != q.distant) return false;
    if (!remembers_same_overlap(p, q)) return false;
    Contact<Dim> beyond = q;
    beyond.gap = extrapolated(p.gap, q.gap);
    if (touches(from, beyond) == q.distant || (q.distant && beyond.gap >= range_of(from, p))) return false;
    if (!q.distant && !sticks(from.law, p, q)) return false;
  }
  return true;
}

template bool is_elastic_step(const Packing<2>&, const Packing<2>&);
template bool is_elastic_step(const Packing<3>&, const Packing<3>&);

}  // namespace floc
