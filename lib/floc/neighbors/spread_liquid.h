#pragma once

#include "floc/packing/liquid/liquid.h"

namespace floc {

/// What sharing out the liquid of a packing anew has changed.
struct LiquidChange {
  int n_formed = 0;  ///< pairs that have a bridge now and had none
  int n_broken = 0;  ///< pairs that had one, broken or not, and have none

  double largest = 0.0;  ///< change of the volume of a bridge, relative to what it was

  int n_changed() const { return n_formed + n_broken; }
  /// Whether everything is as it was, up to rounding.
  bool nothing() const { return n_changed() == 0 && largest < 1e-9; }
};

/// Shares out the liquid of a packing between its pairs of grains as they are now (share_liquid()): contacts
/// that hold none and do not touch leave the list; pairs that come to hold some enter it, with springs at rest.
/// Where bridges form on contact alone, only pairs that touch or have a bridge take part. Forces are those of
/// the new volumes. Does nothing under a law without liquid.
///
/// @throws InputError as find_pairs()
template <int Dim>
LiquidChange spread_liquid(Packing<Dim>& packing);

}  // namespace floc
