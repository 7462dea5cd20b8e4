#pragma once

#include "floc/packing/liquid/liquid.h"

namespace floc {

/// Changes of the bridges when the liquid of a packing is shared out anew.
struct LiquidChange {
  int n_formed = 0;  ///< pairs that have a bridge now and had none
  int n_broken = 0;  ///< pairs that had a bridge, broken or not, and have none now

  double largest = 0.0;  ///< change of the volume of a bridge over its volume before

  int n_changed() const { return n_formed + n_broken; }
  /// Whether no bridge has changed, up to rounding.
  bool nothing() const { return n_changed() == 0 && largest < 1e-9; }
};

/// Shares out the liquid of a packing between its pairs of grains at their present gaps (share_liquid()).
/// Contacts that get no liquid and do not touch are removed from the list; pairs that get liquid are added,
/// with springs at rest. Where bridges form on contact alone, only pairs that touch or have a bridge take part.
/// Forces are computed with the new volumes. Under a law without liquid nothing is changed.
///
/// @throws InputError as find_pairs()
template <int Dim>
LiquidChange spread_liquid(Packing<Dim>& packing);

}  // namespace floc
