#include "floc/relaxation/interaction.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "floc/contact/law_table.h"
#include "floc/relaxation/kernels/kernel_law.h"

namespace floc {

template <int Dim>
Interaction<Dim>::Interaction(Partner partner, const Law& parameters, std::shared_ptr<const ComposedLaw> law,
                              RowKind rows, double largest_radius, InstructionSet instructions,
                              LatticeShape shape)
    : partner_(partner),
      law_(std::move(law)),
      rows_(rows),
      range_(parameters.reach(largest_radius)),
      swap_parity_(swap_parity<Dim>(parameters)),
      kernel_(kernel_of(*law_, partner, instructions, shape)),
      arrays_(pairs_.view()) {}

template <int Dim>
auto Interaction<Dim>::kernel_of(const ComposedLaw& law, Partner partner, InstructionSet instructions,
                                 LatticeShape shape) -> KernelAndLaw {
  const auto kernel = std::make_shared<const AnyKernelLaw<Dim>>(kernel_law<Dim>(law.any, partner));
  return {&step_kernels<Dim>(instructions, shape, kernel->index()), {kernel, address_of_alternative(*kernel)}};
}

template <int Dim>
void Interaction<Dim>::set_pairs(PairArrays<Dim> pairs) {
  pairs.inherit(pairs_);
  pairs_ = std::move(pairs);
  pairs_.refresh_bridges(*law_);
  arrays_ = pairs_.view();
  arrays_.rows = rows_;
}

template <int Dim>
void Interaction<Dim>::compute(const PairView<Dim>& pairs, int first, int last, const GrainView<Dim>& grains,
                               const PairCell<Dim>& cell) const {
  const auto kernel = partner_ == Partner::wall ? kernels().compute_wall_pairs : kernels().compute_pairs;
  kernel(kernel_.law.get(), grains, pairs, pairs_.first_of_block(first), pairs_.first_of_block(last), cell);
}

template <int Dim>
void Interaction<Dim>::load_history(int pair, const ContactHistory<Dim>& history, bool swapped) {
  for (std::size_t k = 0; k < pairs_.history.size(); ++k)
    if (!pairs_.history[k].empty())
      pairs_.history[k][pair] = swapped ? swap_parity_[k] * history[k] : history[k];
}

template <int Dim>
ContactHistory<Dim> Interaction<Dim>::history(int pair, bool swapped) const {
  ContactHistory<Dim> history = ContactHistory<Dim>::Zero();
  for (std::size_t k = 0; k < pairs_.history.size(); ++k)
    if (!pairs_.history[k].empty())
      history[k] = swapped ? swap_parity_[k] * pairs_.history[k][pair] : pairs_.history[k][pair];
  return history;
}

std::vector<std::shared_ptr<const ComposedLaw>> laws_of_same_rows(const std::vector<Law>& parameters) {
  std::vector<AnyContactLaw> laws;
  for (const Law& p : parameters) laws.push_back(compose_law(p));
  if (std::any_of(laws.begin(), laws.end(), kernel_rotates))
    for (std::size_t k = 0; k < laws.size(); ++k)
      if (!kernel_rotates(laws[k])) laws[k] = compose_with_friction(parameters[k]);
  std::vector<std::shared_ptr<const ComposedLaw>> composed;
  for (const AnyContactLaw& law : laws)
    composed.push_back(std::make_shared<const ComposedLaw>(ComposedLaw{law}));
  return composed;
}

template <int Dim>
RowKind row_kind(const ComposedLaw& law) {
  return std::visit([]<class KernelLaw>(const KernelLaw&) { return kRowKind<KernelLaw, Dim>; },
                    kernel_law<Dim>(law.any, Partner::grain));
}

template class Interaction<2>;
template class Interaction<3>;
template RowKind row_kind<2>(const ComposedLaw&);
template RowKind row_kind<3>(const ComposedLaw&);

}  // namespace floc
