#pragma once

#include <vector>

#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"
#include "floc/relaxation/motion_since_list.h"

namespace floc {

/// Rule for the width of the skin of the lists of neighbours.
enum class SkinRule {
  balances_costs,  ///< building lists takes about as much time as the listed pairs out of range
  follows_reach,   ///< the skin is a fixed share of the range of the interaction between grains
};

/// Verlet lists of the bodies of a packing in motion. This class finds the pairs that may interact before the
/// next lists are built, and chooses the time and the skin of the next lists. The interactions own the pairs
/// that it finds.
template <int Dim>
class NeighborLists {
 public:
  /// @param skin  first guess (length)
  NeighborLists(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell, double skin, SkinRule rule);

  /// Adapts the skin to the cost of the lists so far, and finds the pairs of each interaction anew. The lists hold
  /// one pair for each two bodies.
  PairLists<Dim> find(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                      const Interactions<Dim>& interactions);
  /// Whether the lists have to be built anew, because by the bound of the motion a pair outside them may
  /// interact, or because they hold too many pairs out of range.
  /// @param range  gap across which grains interact (length)
  bool stale(const CellMotion<Dim>& cell, double range) const;
  /// First guess of the skin for another object that continues this motion and builds lists at once (length).
  double skin_to_continue_with(const CellMotion<Dim>& cell, double range) const;

  const MotionSinceList<Dim>& motion() const { return motion_; }
  MotionSinceList<Dim>& motion() { return motion_; }
  /// Counts a time step, and adds a bound of its motion (MotionSinceList::add_step).
  void add_step(const CellMotion<Dim>& cell, const std::vector<BlockSums<Dim>>& sums, const Kick<Dim>& kick,
                const Drift<Dim>& drift);

 private:
  double min_skin() const;
  double cost_share() const;
  double consumed_skin(const CellMotion<Dim>& cell, double range) const;
  void adapt_skin(const CellMotion<Dim>& cell, const Interaction<Dim>& between_grains);
  std::vector<double> skins_of_grains(const GrainArrays<Dim>& grains) const;
  std::vector<NeighborPair<Dim>> find(const Interaction<Dim>& interaction, const CellMotion<Dim>& cell,
                                      const Grains<Dim>& with_skins) const;
  double share_out_of_range(const std::vector<NeighborPair<Dim>>& pairs, const GrainArrays<Dim>& grains,
                            const CellMotion<Dim>& cell, double range) const;

  double skin_;  ///< skin of a pair of the fastest grains (length)
  SkinRule rule_;
  double largest_diameter_;
  double skin_unit_;  ///< skin_length_unit()
  MotionSinceList<Dim> motion_;
  int steps_ = 0;                    ///< since the lists were built
  bool first_ = true;                ///< no step has been made with other lists than the first
  double share_out_of_range_ = 0.0;  ///< share of the time of a step spent on pairs out of range, in new lists
};

}  // namespace floc
