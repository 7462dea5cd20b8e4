#include "floc/relaxation/interactions.h"

#include <algorithm>

#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Adds the second and later contacts of bodies to a list of pairs. The list contains one pair for any two bodies that
/// are close. If two bodies have no pair in the list, their contacts are left out.
template <int Dim>
void add_further(std::vector<NeighborPair<Dim>> further, std::vector<NeighborPair<Dim>>& pairs) {
  if (further.empty()) return;
  std::erase_if(further, [&](NeighborPair<Dim> first) {
    first.key = 0;
    return !std::binary_search(pairs.begin(), pairs.end(), first, precedes<NeighborPair<Dim>>);
  });
  pairs.insert(pairs.end(), further.begin(), further.end());
  std::sort(pairs.begin(), pairs.end(), precedes<NeighborPair<Dim>>);
}

}  // namespace

template <int Dim>
Interactions<Dim>::Interactions(const Packing<Dim>& packing, InstructionSet instructions, LatticeShape shape) {
  std::vector<Law> parameters = {packing.law};
  if (!packing.walls.empty()) parameters.push_back(packing.wall_law);
  const auto laws = laws_of_same_rows(parameters);
  for (std::size_t k = 0; k < laws.size(); ++k)
    list_.emplace_back(k == 0 ? Partner::grain : Partner::wall, parameters[k], laws[k], row_kind<Dim>(*laws[0]),
                       0.5 * largest_diameter(packing.grains), instructions, shape);
}

template <int Dim>
PairLists<Dim> Interactions<Dim>::further_contacts() const {
  PairLists<Dim> further;
  for (const Interaction<Dim>& interaction : list_) further.push_back(interaction.pairs().further_contacts());
  return further;
}

template <int Dim>
void Interactions<Dim>::set_pairs(PairLists<Dim> close, const PairLists<Dim>& further,
                                  const GrainArrays<Dim>& grains, double time_step, int blocks_of_group) {
  for (std::size_t k = 0; k < list_.size(); ++k) {
    Interaction<Dim>& interaction = list_[k];
    add_further(further[k], close[k]);
    // Lists of pairs are large, so memory is freed early: the force data of the old list before the new list is made,
    // and the new pairs as soon as they have been copied.
    interaction.drop_numbers();
    interaction.set_pairs(
        {close[k], interaction.partner(), grains, interaction.law(), time_step, blocks_of_group});
    close[k] = std::vector<NeighborPair<Dim>>();
  }
}

template <int Dim>
void Interactions<Dim>::keep_history_alone() {
  for (Interaction<Dim>& interaction : list_) interaction.keep_history_alone();
}

template class Interactions<2>;
template class Interactions<3>;

}  // namespace floc
