#include "floc/contact/history_layout.h"

namespace floc {
namespace {

template <class Slot>
void add_quantities(const Slot& slot, int begin, int dim, std::vector<HistoryQuantity>& quantities) {
  slot.visit([&]<class Model>(const Model&) {
    if constexpr (requires { Model::kHistory; })
      for (const History& m : Model::kHistory) {
        quantities.push_back({m, begin, n_components(m.kind, dim)});
        begin += quantities.back().size;
      }
  });
}

template <int Dim>
std::vector<HistoryQuantity> quantities_of(const LawParameters& law) {
  std::vector<HistoryQuantity> quantities;
  add_quantities(law.normal, HistoryLayout<Dim>::kNormal, Dim, quantities);
  add_quantities(law.friction, HistoryLayout<Dim>::kFriction, Dim, quantities);
  add_quantities(law.rolling, HistoryLayout<Dim>::kRolling, Dim, quantities);
  add_quantities(law.twisting, HistoryLayout<Dim>::kTwisting, Dim, quantities);
  add_quantities(law.adhesion, HistoryLayout<Dim>::kAdhesion, Dim, quantities);
  return quantities;
}

}  // namespace

std::vector<HistoryQuantity> history_quantities(const Law& law, int dim) {
  return dim == 2 ? quantities_of<2>(law) : quantities_of<3>(law);
}

template <int Dim>
ContactHistory<Dim> swap_parity(const Law& law) {
  ContactHistory<Dim> factor = ContactHistory<Dim>::Ones();
  for (const HistoryQuantity& q : quantities_of<Dim>(law))
    factor.segment(q.begin, q.size).setConstant(parity(q.declared.kind, Dim));
  return factor;
}

template ContactHistory<2> swap_parity<2>(const Law&);
template ContactHistory<3> swap_parity<3>(const Law&);

}  // namespace floc
