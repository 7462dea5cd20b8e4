#include "floc/contact/memory_layout.h"

namespace floc {
namespace {

template <class Slot>
void add_quantities(const Slot& slot, int begin, int dim, std::vector<RememberedQuantity>& quantities) {
  slot.visit([&]<class Model>(const Model&) {
    if constexpr (requires { Model::kMemory; })
      for (const Memory& m : Model::kMemory) {
        quantities.push_back({m, begin, n_components(m.kind, dim)});
        begin += quantities.back().size;
      }
  });
}

template <int Dim>
std::vector<RememberedQuantity> quantities_of(const LawParameters& law) {
  std::vector<RememberedQuantity> quantities;
  add_quantities(law.normal, MemoryLayout<Dim>::kNormal, Dim, quantities);
  add_quantities(law.friction, MemoryLayout<Dim>::kFriction, Dim, quantities);
  add_quantities(law.rolling, MemoryLayout<Dim>::kRolling, Dim, quantities);
  add_quantities(law.twisting, MemoryLayout<Dim>::kTwisting, Dim, quantities);
  add_quantities(law.adhesion, MemoryLayout<Dim>::kAdhesion, Dim, quantities);
  return quantities;
}

}  // namespace

std::vector<RememberedQuantity> remembered_quantities(const Law& law, int dim) {
  return dim == 2 ? quantities_of<2>(law) : quantities_of<3>(law);
}

template <int Dim>
ContactMemory<Dim> swap_parity(const Law& law) {
  ContactMemory<Dim> factor = ContactMemory<Dim>::Ones();
  for (const RememberedQuantity& q : quantities_of<Dim>(law))
    factor.segment(q.begin, q.size).setConstant(parity(q.declared.kind, Dim));
  return factor;
}

template ContactMemory<2> swap_parity<2>(const Law&);
template ContactMemory<3> swap_parity<3>(const Law&);

}  // namespace floc
