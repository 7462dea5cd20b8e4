#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"

namespace floc {

/// Histories of the contacts of a packing that is set in motion. They are stored here until lists of pairs
/// exist to load them into.
template <int Dim>
class ContactHistories {
 public:
  /// Takes the contacts out of a packing, so that a large one is not held twice.
  /// @param grains  arrays of the grains of the packing
  ContactHistories(Packing<Dim>& packing, const GrainArrays<Dim>& grains);

  /// Contacts beside the first contact of their pair: those between grains, then those with walls.
  PairLists<Dim> further_contacts() const;
  /// Copies the histories into the pairs of the contacts, and computes the parameters of their liquid bridges.
  void load_into(Interactions<Dim>& interactions) const;

 private:
  struct History {
    NeighborPair<Dim> pair;  ///< places of the grains in their arrays
    bool on_wall;
    bool swapped;  ///< whether the pair is the contact seen from its other grain
    ContactHistory<Dim> history;
  };
  std::vector<History> histories_;
};

}  // namespace floc
