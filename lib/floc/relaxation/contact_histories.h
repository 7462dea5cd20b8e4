#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"

namespace floc {

/// History variables of the contacts of a packing that is set in motion. This object stores the variables until the
/// lists of neighbouring pairs have been built, and then copies the variables into the lists.
template <int Dim>
class ContactHistories {
 public:
  /// Moves the contacts out of a packing, so that the contacts of a large packing are not stored twice.
  /// @param grains  arrays of the grains of the packing
  ContactHistories(Packing<Dim>& packing, const GrainArrays<Dim>& grains);

  /// Returns the second and later contacts of all bodies with several contacts between them: first the contacts between
  /// grains, then the contacts with walls.
  PairLists<Dim> further_contacts() const;
  /// Copies the stored history variables of the contacts into the lists of pairs, and computes the parameters of their
  /// liquid bridges.
  void load_into(Interactions<Dim>& interactions) const;

 private:
  struct History {
    NeighborPair<Dim> pair;  ///< the two bodies; a grain is given by its place in the arrays of grains
    bool on_wall;
    bool swapped;  ///< whether the first grain of the pair is the second grain of the contact
    ContactHistory<Dim> history;
  };
  std::vector<History> histories_;
};

}  // namespace floc
