#include "floc/relaxation/neighbor_lists.h"

#include <algorithm>
#include <cmath>

#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Computing time for building new lists of pairs, divided by the computing time of a time step (measured with 1400 and
/// 100 000 grains).
constexpr double kListCost = 23.0;
/// Smallest skin of a grain, divided by the skin of the fastest grains. (The skin of a grain is the distance that the
/// grain may move before new neighbour lists are built.) Grains at rest need a skin, too, since other grains may hit
/// them.
constexpr double kMinSkinShare = 0.25;
/// Smallest skin of a neighbour list, in units of skin_length_unit(). The skin is the extra distance up to which pairs
/// are listed.
constexpr double kMinSkin = 1e-4;
/// Skin divided by the range of the interaction, under SkinRule::follows_reach. The skin limits how far two surfaces
/// may approach each other before new lists are built.
constexpr double kSkinOfReach = 0.25;
/// Smallest skin of a neighbour list under SkinRule::follows_reach, in units of skin_length_unit().
constexpr double kMinSkinOfReach = 1e-3;

}  // namespace

template <int Dim>
NeighborLists<Dim>::NeighborLists(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell, double skin,
                                  SkinRule rule)
    : skin_(skin), rule_(rule), motion_(grains.n_blocks(), cell) {
  const std::span<const double> of_grains = grains.of_grains(grains.radius);
  const std::vector<double> radius(of_grains.begin(), of_grains.end());
  largest_diameter_ = largest_diameter(radius);
  skin_unit_ = skin_length_unit(radius);
}

template <int Dim>
double NeighborLists<Dim>::min_skin() const {
  return kMinSkin * skin_unit_;
}

/// Returns the computing time of building the present lists, divided by the computing time of all steps made with these
/// lists. A part of the time of each step is spent on listed pairs that are too far apart to interact. The skin is
/// optimal if the returned ratio equals the share of this part.
template <int Dim>
double NeighborLists<Dim>::cost_share() const {
  return kListCost / steps_;
}

/// Returns an upper bound of the length by which the motion since the lists were built has reduced the skin (length).
/// The bound is the sum of the largest displacement of a body and the affine shortening of distances.
template <int Dim>
double NeighborLists<Dim>::consumed_skin(const CellMotion<Dim>& cell, double range) const {
  return std::max(motion_.of_grains() * skin_, 2.0 * motion_.of_walls(cell.walls())) +
         motion_.shrinking() * (largest_diameter_ + range + skin_) / kMinSkinShare;
}

template <int Dim>
bool NeighborLists<Dim>::stale(const CellMotion<Dim>& cell, double range) const {
  if (rule_ == SkinRule::balances_costs && cost_share() < 0.5 * share_out_of_range_ && skin_ > min_skin())
    return true;
  return !(consumed_skin(cell, range) < skin_);
}

template <int Dim>
double NeighborLists<Dim>::skin_to_continue_with(const CellMotion<Dim>& cell, double range) const {
  if (!first_ || steps_ == 0) return skin_;
  // The first lists were valid during the whole motion. For the next lists it suffices that the skin is twice the
  // distance that bodies have moved.
  return std::min(skin_, std::max(2.0 * consumed_skin(cell, range), min_skin()));
}

template <int Dim>
void NeighborLists<Dim>::add_step(const CellMotion<Dim>& cell, const std::vector<BlockSums<Dim>>& sums,
                                  const Kick<Dim>& kick, const Drift<Dim>& drift, double fall) {
  motion_.add_step(cell, sums, kick, drift, fall);
  ++steps_;
}

template <int Dim>
void NeighborLists<Dim>::adapt_skin(const CellMotion<Dim>& cell, const Interaction<Dim>& between_grains) {
  if (rule_ == SkinRule::follows_reach) {
    skin_ = std::clamp(kSkinOfReach * between_grains.range(), kMinSkinOfReach * skin_unit_,
                       0.5 * largest_diameter_);
    return;
  }
  if (between_grains.pairs().size() == 0 || steps_ == 0) return;
  first_ = false;
  const double cost = cost_share();
  if (cost > share_out_of_range_)
    skin_ = std::min((cost > 4.0 * share_out_of_range_ ? 2.0 : 1.25) * skin_, 0.5 * largest_diameter_);
  // If the next lists are used for as many steps as the present lists, it suffices that their skin is twice the
  // distance that bodies have moved.
  if (cost < 0.5 * share_out_of_range_)
    skin_ = std::max(std::min(0.8 * skin_, 2.0 * consumed_skin(cell, between_grains.range())), min_skin());
}

template <int Dim>
PairLists<Dim> NeighborLists<Dim>::find(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                                        const Interactions<Dim>& interactions) {
  adapt_skin(cell, interactions.between_grains());
  const std::vector<double> skin = skins_of_grains(grains);
  motion_.begin(grains, cell, skin, 0.5 * kMinSkinShare * skin_);
  Grains<Dim> with_skins;  // grains with their skins added to their radii; only positions and radii are set
  with_skins.position.resize(grains.size());
  with_skins.radius.resize(grains.size());
  grains.copy_positions_to(with_skins);
  for (int k = 0; k < grains.size(); ++k) with_skins.radius[k] = grains.radius[k] + skin[k];
  PairLists<Dim> close;
  for (const Interaction<Dim>& interaction : interactions) close.push_back(find(interaction, cell, with_skins));
  share_out_of_range_ = share_out_of_range(close[0], grains, cell, interactions.between_grains().range());
  steps_ = 0;
  return close;
}

/// Returns the pairs of an interaction that may interact while no body has moved by more than its skin.
/// @param with_skins  grains with their skins added to their radii
template <int Dim>
std::vector<NeighborPair<Dim>> NeighborLists<Dim>::find(const Interaction<Dim>& interaction,
                                                        const CellMotion<Dim>& cell,
                                                        const Grains<Dim>& with_skins) const {
  const double range = interaction.range();
  const std::vector<Wall<Dim>>& walls = cell.walls().walls();
  if (interaction.partner() == Partner::wall) return find_wall_pairs(walls, with_skins, range + 0.5 * skin_);
  return find_pairs(search_cell(cell.cell(), walls, largest_diameter_ + range + skin_), with_skins, range);
}

/// Returns the skin of each grain, the distance that it may move before new lists are built (length). All lists are
/// replaced at the same time, so faster grains get a wider skin.
template <int Dim>
std::vector<double> NeighborLists<Dim>::skins_of_grains(const GrainArrays<Dim>& grains) const {
  std::vector<double> speed(grains.size());
  for (int k = 0; k < grains.size(); ++k) {
    double squared = 0.0;
    for (int a = 0; a < Dim; ++a) squared += grains.v[a][k] * grains.v[a][k];
    speed[k] = std::sqrt(squared);
  }
  const double fastest = speed.empty() ? 0.0 : *std::max_element(speed.begin(), speed.end());
  // Speeds cannot be compared if the motion has diverged.
  const bool comparable = fastest > 0.0 && std::isfinite(fastest);
  std::vector<double> skin(grains.size());
  for (int k = 0; k < grains.size(); ++k)
    skin[k] = 0.5 * skin_ * (comparable ? std::max(speed[k] / fastest, kMinSkinShare) : 1.0);
  return skin;
}

/// Returns the share of the computing time of a step that is spent on listed pairs that are too far apart to interact.
/// The estimate assumes that a grain takes as much time as a pair.
template <int Dim>
double NeighborLists<Dim>::share_out_of_range(const std::vector<NeighborPair<Dim>>& pairs,
                                              const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                                              double range) const {
  std::size_t out_of_range = 0;
  for (const NeighborPair<Dim>& p : pairs) {
    const Vec<Dim> shift = cell.image_shift(p.image);
    double squared = 0.0;
    for (int a = 0; a < Dim; ++a) {
      const double r = grains.x[a][p.j] - grains.x[a][p.i] + shift[a];
      squared += r * r;
    }
    const double reach = grains.radius[p.i] + grains.radius[p.j] + range;
    out_of_range += squared >= reach * reach;
  }
  return static_cast<double>(out_of_range) /
         static_cast<double>(pairs.size() + static_cast<std::size_t>(grains.size()));
}

template class NeighborLists<2>;
template class NeighborLists<3>;

}  // namespace floc
