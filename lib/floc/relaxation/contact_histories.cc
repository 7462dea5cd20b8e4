#include "floc/relaxation/contact_histories.h"

#include "floc/packing/contact_order.h"

namespace floc {

template <int Dim>
ContactHistories<Dim>::ContactHistories(Packing<Dim>& packing, const GrainArrays<Dim>& grains) {
  std::vector<int> place(grains.size());
  for (int k = 0; k < grains.size(); ++k) place[grains.index[k]] = k;
  histories_.reserve(packing.contacts.size());
  for (const Contact<Dim>& c : packing.contacts) {
    const bool on_wall = c.j >= grains.size();
    const NeighborPair<Dim> pair{place[c.i], on_wall ? c.j - grains.size() : place[c.j], c.image, c.key};
    const bool swap = !on_wall && pair.j < pair.i;
    histories_.push_back({swap ? swapped(pair) : pair, on_wall, swap, c.history});
  }
  // The assignment `packing.contacts = {}` would not free the memory of the contacts.
  packing.contacts = std::vector<Contact<Dim>>();
}

template <int Dim>
PairLists<Dim> ContactHistories<Dim>::further_contacts() const {
  PairLists<Dim> further(2);
  for (const History& history : histories_)
    if (history.pair.key != 0) further[history.on_wall ? 1 : 0].push_back(history.pair);
  return further;
}

template <int Dim>
void ContactHistories<Dim>::load_into(Interactions<Dim>& interactions) const {
  for (const History& history : histories_) {
    Interaction<Dim>& interaction = history.on_wall ? interactions.on_walls() : interactions.between_grains();
    const int p = interaction.pairs().find(history.pair);
    if (p >= 0) interaction.load_history(p, history.history, history.swapped);
  }
  interactions.between_grains().refresh_bridges();
}

template class ContactHistories<2>;
template class ContactHistories<3>;

}  // namespace floc
