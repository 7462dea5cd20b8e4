#pragma once

#include "floc/packing/liquid/liquid.h"

namespace floc {

/// Changes of the liquid bridges of a packing when its liquid is distributed again.
struct LiquidChange {
  int n_formed = 0;  ///< number of pairs of grains that had no liquid bridge before and have one afterwards
  /// number of pairs of grains that had a liquid bridge (intact or broken) before and have none afterwards
  int n_broken = 0;

  double largest = 0.0;  ///< largest relative change of the volume of a liquid bridge that existed before

  int n_changed() const { return n_formed + n_broken; }
  /// Returns whether no liquid bridge has changed, up to rounding.
  bool nothing() const { return n_changed() == 0 && largest < 1e-9; }
};

/// Distributes the liquid of a packing over its pairs of grains, according to the present gaps (share_liquid()). A
/// contact whose grains do not touch and that gets no liquid is removed from the packing. A pair that gets liquid and
/// is not a contact yet is added as a contact with unloaded springs. If the contact law forms bridges only on contact,
/// only pairs that touch or have a bridge get liquid. The contact forces are recomputed with the new volumes of the
/// bridges. If the contact law has no liquid, nothing is changed.
///
/// @throws InputError if find_pairs() throws it
template <int Dim>
LiquidChange spread_liquid(Packing<Dim>& packing);

}  // namespace floc
