#pragma once

#include <deque>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/relaxation/interaction.h"

namespace floc {

/// Pairs of each interaction of a packing: those between grains, then those with walls.
template <int Dim>
using PairLists = std::vector<std::vector<NeighborPair<Dim>>>;

/// All interactions of a packing: between its grains and, where it has walls, between grains and walls. The rows
/// that their pairs write are all of one kind, since they are summed together.
template <int Dim>
class Interactions {
 public:
  Interactions(const Packing<Dim>& packing, InstructionSet instructions, LatticeShape shape);

  bool with_walls() const { return list_.size() > 1; }
  Interaction<Dim>& between_grains() { return list_.front(); }
  const Interaction<Dim>& between_grains() const { return list_.front(); }
  /// @pre with_walls()
  Interaction<Dim>& on_walls() { return list_.back(); }
  const Interaction<Dim>& on_walls() const { return list_.back(); }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

  /// Contacts of each interaction beside the first contact of their pair. Their keys distinguish them as long
  /// as their bodies are close.
  PairLists<Dim> further_contacts() const;
  /// Takes new lists of pairs, which inherit the history of the lists before.
  /// @param close            pairs of bodies that are close, for each interaction
  /// @param further          contacts beside the first contact of their pair, for each interaction
  /// @param blocks_of_group  blocks whose pairs are always computed together
  void set_pairs(PairLists<Dim> close, const PairLists<Dim>& further, const GrainArrays<Dim>& grains,
                 double time_step, int blocks_of_group);
  /// Drops all data but the histories.
  void keep_history_alone();

 private:
  std::deque<Interaction<Dim>> list_;  ///< between grains first, then with walls
};

}  // namespace floc
