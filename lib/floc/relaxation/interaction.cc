#include "floc/relaxation/interaction.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace floc {

template <int Dim>
Interaction<Dim>::Interaction(Partner partner, const Law& parameters, const AnyContactLaw& law, RowKind rows,
                              double largest_radius, InstructionSet instructions, LatticeShape shape)
    : partner_(partner),
      law_(law),
      rows_(rows),
      range_(parameters.reach(largest_radius)),
      swap_parity_(swap_parity<Dim>(parameters)),
      kernel_law_(kernel_law<Dim>(law, partner)),
      kernels_(step_kernels<Dim>(instructions, shape, kernel_law_.index())),
      law_of_kernel_(address_of_alternative(kernel_law_)),
      arrays_(pairs_.view()) {}

template <int Dim>
void Interaction<Dim>::set_pairs(PairArrays<Dim> pairs) {
  pairs.inherit(pairs_);
  pairs_ = std::move(pairs);
  pairs_.refresh_bridges(law_);
  arrays_ = pairs_.view();
  arrays_.rows = rows_;
}

template <int Dim>
void Interaction<Dim>::compute(const PairView<Dim>& pairs, int first, int last, const GrainView<Dim>& grains,
                               const PairCell<Dim>& cell) const {
  const auto kernel = partner_ == Partner::wall ? kernels_.compute_wall_pairs : kernels_.compute_pairs;
  kernel(law_of_kernel_, grains, pairs, pairs_.first_of_block(first), pairs_.first_of_block(last), cell);
}

template <int Dim>
void Interaction<Dim>::load_memory(int pair, const ContactMemory<Dim>& memory, bool swapped) {
  for (std::size_t k = 0; k < pairs_.memory.size(); ++k)
    if (!pairs_.memory[k].empty()) pairs_.memory[k][pair] = swapped ? swap_parity_[k] * memory[k] : memory[k];
}

template <int Dim>
ContactMemory<Dim> Interaction<Dim>::memory(int pair, bool swapped) const {
  ContactMemory<Dim> memory = ContactMemory<Dim>::Zero();
  for (std::size_t k = 0; k < pairs_.memory.size(); ++k)
    if (!pairs_.memory[k].empty())
      memory[k] = swapped ? swap_parity_[k] * pairs_.memory[k][pair] : pairs_.memory[k][pair];
  return memory;
}

std::vector<AnyContactLaw> laws_of_same_rows(const std::vector<Law>& parameters) {
  std::vector<AnyContactLaw> laws;
  for (const Law& p : parameters) laws.push_back(compose_law(p));
  if (std::any_of(laws.begin(), laws.end(), kernel_rotates))
    for (std::size_t k = 0; k < laws.size(); ++k)
      if (!kernel_rotates(laws[k])) laws[k] = compose_with_friction(parameters[k]);
  return laws;
}

template <int Dim>
RowKind row_kind(const AnyContactLaw& law) {
  return std::visit([]<class Law>(const Law&) { return kRowKind<Law, Dim>; },
                    kernel_law<Dim>(law, Partner::grain));
}

template class Interaction<2>;
template class Interaction<3>;
template RowKind row_kind<2>(const AnyContactLaw&);
template RowKind row_kind<3>(const AnyContactLaw&);

}  // namespace floc
