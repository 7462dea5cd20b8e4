#pragma once

#include <vector>

#include "floc/packing/liquid/liquid.h"
#include "floc/packing/packing.h"
#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interaction.h"

namespace floc {

/// Liquid bridges of a packing in motion. This class computes the gap that lists of pairs have to reach across,
/// and shares the liquid out over the pairs.
template <int Dim>
class LiquidBridges {
 public:
  /// @param law           law between grains. @pre law.liquid() is not null
  /// @param keeps_shares  whether bridges keep their volumes; otherwise liquid is shared out with every list
  LiquidBridges(const Law& law, const GrainArrays<Dim>& grains, bool keeps_shares);

  bool keeps_shares() const { return keeps_shares_; }
  /// Gap for the first lists of pairs (length): the lists then hold every pair that has liquid or may get some.
  double first_reach(const Packing<Dim>& packing) const;
  /// Gap for new lists of pairs (length): the lists then hold every pair that has liquid.
  double reach(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
               const Interaction<Dim>& between_grains) const;
  /// Shares the liquid out over the pairs.
  /// @return  false where pairs further apart might get liquid: the range of the interaction has been widened, and
  ///          the liquid has to be shared out again over new lists
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
