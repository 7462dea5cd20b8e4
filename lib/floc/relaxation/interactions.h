#pragma once

#include <deque>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/relaxation/interaction.h"

namespace floc {

/// Pairs of bodies, one list per interaction of a packing: pairs of grains, then pairs of grains with walls.
template <int Dim>
using PairLists = std::vector<std::vector<NeighborPair<Dim>>>;

/// All interactions of a packing: between its grains and, if it has walls, between grains and walls. The kernels write
/// the force and the moments of each pair as a row of numbers. The rows of all interactions have one layout, since they
/// are summed together.
template <int Dim>
class Interactions {
 public:
  Interactions(const Packing<Dim>& packing, InstructionSet instructions, LatticeShape shape);

  bool with_walls() const { return list_.size() > 1; }
  Interaction<Dim>& between_grains() { return list_.front(); }
  const Interaction<Dim>& between_grains() const { return list_.front(); }
  /// Returns the interaction between grains and walls. @pre with_walls()
  Interaction<Dim>& on_walls() { return list_.back(); }
  const Interaction<Dim>& on_walls() const { return list_.back(); }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

  /// For each interaction, returns the second and later contacts of all bodies with several contacts between them. The
  /// contacts of two bodies have different keys (NeighborPair::key), which do not change as long as the bodies are
  /// close.
  PairLists<Dim> further_contacts() const;
  /// Replaces the lists of pairs. Pairs that are in the old and in the new lists keep their history variables.
  /// @param close  for each interaction, pairs of bodies that are close
  /// @param further  for each interaction, the result of further_contacts() or of ContactHistories::further_contacts()
  /// @param blocks_of_group  number of consecutive blocks of grains whose pairs are computed together
  void set_pairs(PairLists<Dim> close, const PairLists<Dim>& further, const GrainArrays<Dim>& grains,
                 double time_step, int blocks_of_group);
  /// Frees all data except the history variables of the pairs.
  void keep_history_alone();

 private:
  /// The interaction between grains, followed by the interaction between grains and walls if there are walls.
  std::deque<Interaction<Dim>> list_;
};

}  // namespace floc
