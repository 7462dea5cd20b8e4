#pragma once

#include <vector>

#include "floc/packing/liquid/liquid.h"
#include "floc/packing/packing.h"
#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interaction.h"

namespace floc {

/// Liquid bridges of a packing in motion. This class computes the largest gap of pairs of grains that the lists of
/// neighbours have to contain, and shares the liquid out among the listed pairs.
template <int Dim>
class LiquidBridges {
 public:
  /// @param law           contact law between grains; law.liquid() is not null
  /// @param keeps_shares  whether bridges keep their volumes; if not, the liquid is shared out whenever new lists of
  /// pairs are built
  LiquidBridges(const Law& law, const GrainArrays<Dim>& grains, bool keeps_shares);

  bool keeps_shares() const { return keeps_shares_; }
  /// Returns the gap up to which the first lists of neighbours have to contain pairs (length). With this gap, the lists
  /// contain every pair that has liquid or may get liquid.
  double first_reach(const Packing<Dim>& packing) const;
  /// Returns the gap up to which new lists of neighbours have to contain pairs (length). With this gap, the lists
  /// contain every pair that has liquid.
  double reach(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
               const Interaction<Dim>& between_grains) const;
  /// Shares the liquid out among the listed pairs of grains.
  /// @return false if pairs that are too far apart to be listed might get liquid. In this case, the range of
  /// `between_grains` has been widened: new lists have to be built, and the liquid has to be shared out again.
  [[nodiscard]] bool share_out(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                               Interaction<Dim>& between_grains) const;

 private:
  LiquidShares shares(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                      const PairArrays<Dim>& pairs) const;

  Law law_;
  BridgeSearch search_;
  bool keeps_shares_;
};

}  // namespace floc
