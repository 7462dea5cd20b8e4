#pragma once

#include "floc/packing/liquid/liquid.h"

namespace floc {

/// Changes of the liquid bridges of a packing when its liquid is distributed over them anew.
struct LiquidChange {
  int n_formed = 0;  ///< number of pairs of grains that had no liquid bridge before and have one now
  int n_broken =
      0;  ///< number of pairs of grains that had a liquid bridge before (intact or broken) and have none now

  double largest = 0.0;  ///< largest relative change of the volume of a liquid bridge that existed before

  int n_changed() const { return n_formed + n_broken; }
  /// Returns whether no liquid bridge has changed, up to rounding.
  bool nothing() const { return n_changed() == 0 && largest < 1e-9; }
};

/// Distributes the liquid of a packing over its pairs of grains, according to their present gaps (share_liquid()).
/// Contacts that get no liquid and do not touch are removed from the packing; pairs that get liquid are added as
/// contacts with unloaded springs. If the contact law lets bridges form only on contact, only pairs that touch or have
/// a bridge get liquid. The contact forces are recomputed with the new volumes of the bridges. If the contact law has
/// no liquid, nothing is changed.
///
/// @throws InputError under the conditions of find_pairs()
template <int Dim>
LiquidChange spread_liquid(Packing<Dim>& packing);

}  // namespace floc
