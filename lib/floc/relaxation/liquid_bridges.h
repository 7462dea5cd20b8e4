#pragma once

#include <vector>

#include "floc/packing/liquid/liquid.h"
#include "floc/packing/packing.h"
#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interaction.h"

namespace floc {

/// Liquid bridges of a packing in motion. This class computes the gap across which pairs of grains have to be listed,
/// and shares the liquid out among the pairs.
template <int Dim>
class LiquidBridges {
 public:
  /// @param law           contact law between grains. @pre law.liquid() is not null
  /// @param keeps_shares  whether bridges keep their volumes; otherwise the liquid is shared out whenever new lists of
  /// pairs are built
  LiquidBridges(const Law& law, const GrainArrays<Dim>& grains, bool keeps_shares);

  bool keeps_shares() const { return keeps_shares_; }
  /// Returns the gap across which the first lists of pairs have to reach (length). These lists then contain every pair
  /// that has liquid or may get some.
  double first_reach(const Packing<Dim>& packing) const;
  /// Returns the gap across which new lists of pairs have to reach (length). These lists then contain every pair that
  /// has liquid.
  double reach(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
               const Interaction<Dim>& between_grains) const;
  /// Shares the liquid out among the listed pairs of grains.
  /// @return false if pairs that are further apart might get liquid. The range of the interaction has then been
  /// widened, and the liquid has to be shared out again over new lists.
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
