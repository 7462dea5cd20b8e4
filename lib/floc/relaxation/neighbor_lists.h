#pragma once

#include <vector>

#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"
#include "floc/relaxation/motion_since_list.h"

namespace floc {

/// Rule for the width of the skin, the extra distance up to which pairs are put on the lists of neighbours (Verlet
/// lists).
enum class SkinRule {
  /// The skin is chosen so that building the lists takes about as much time as computing those listed pairs that are
  /// too far apart to interact.
  balances_costs,
  follows_reach,  ///< the skin is a fixed share of the range of the interaction between grains
};

/// Verlet lists of the neighbours of grains in motion. This class finds the pairs that may interact before the next
/// lists are built, and chooses the skin of the next lists and the time at which they are built. The lists are stored
/// in the interactions.
template <int Dim>
class NeighborLists {
 public:
  /// @param skin  first guess of the skin, the extra distance up to which pairs are listed (length)
  NeighborLists(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell, double skin, SkinRule rule);

  /// Adapts the skin (extra distance up to which pairs are listed), so that the lists cost less computing time, and
  /// finds the pairs of each interaction anew. Each list contains one pair for any two bodies that are close.
  PairLists<Dim> find(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                      const Interactions<Dim>& interactions);
  /// Whether new lists have to be built. There are two reasons: by the upper bound of the motion, a pair that is not
  /// listed may interact; or the lists contain too many pairs that are too far apart to interact.
  /// @param range  gap across which grains interact (length)
  bool stale(const CellMotion<Dim>& cell, double range) const;
  /// Returns a first guess of the skin (length) for another object of this class that takes over during the motion.
  double skin_to_continue_with(const CellMotion<Dim>& cell, double range) const;

  const MotionSinceList<Dim>& motion() const { return motion_; }
  MotionSinceList<Dim>& motion() { return motion_; }
  /// Counts a time step, and adds an upper bound of the motion in this step (MotionSinceList::add_step()).
  void add_step(const CellMotion<Dim>& cell, const std::vector<BlockSums<Dim>>& sums, const Kick<Dim>& kick,
                const Drift<Dim>& drift, double fall);

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

  double skin_;  ///< skin of a pair, if both grains are among the fastest (length)
  SkinRule rule_;
  double largest_diameter_;
  double skin_unit_;  ///< unit of the limits of the skin, from skin_length_unit() (length)
  MotionSinceList<Dim> motion_;
  int steps_ = 0;      ///< number of time steps since the lists were built
  bool first_ = true;  ///< whether all time steps so far have been made with the first lists
  /// Share of the computing time of a step that is spent on listed pairs that are too far apart to interact, estimated
  /// when the lists were built.
  double share_out_of_range_ = 0.0;
};

}  // namespace floc
