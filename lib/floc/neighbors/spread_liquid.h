#pragma once

#include "floc/packing/liquid/liquid.h"

namespace floc {

/// Changes of the liquid bridges of a packing when its liquid is distributed anew.
struct LiquidChange {
  int n_formed = 0;  ///< number of pairs of grains that had no liquid bridge before and have one now
  /// number of pairs of grains that had a liquid bridge before (intact or broken) and have none now
  int n_broken = 0;

  double largest = 0.0;  ///< largest relative change of the volume of a liquid bridge that existed before

  int n_changed() const { return n_formed + n_broken; }
  /// Returns whether no liquid bridge has changed, up to rounding.
  bool nothing() const { return n_changed() == 0 && largest < 1e-9; }
};

/// Distributes the liquid of a packing over its pairs of grains, according to their present gaps (share_liquid()).
/// Contacts that get no liquid and do not touch are removed from the packing; pairs that get liquid are added as
/// contacts with unloaded springs. If bridges form only on contact under the contact law, only pairs that touch or have
/// a bridge get liquid. The contact forces are recomputed with the new volumes of the bridges. If the contact law has
/// no liquid, nothing is changed.
///
/// @throws InputError if find_pairs() throws it
template <int Dim>
LiquidChange spread_liquid(Packing<Dim>& packing);

}  // namespace floc
