#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "floc/relaxation/explicit_dynamics.h"

/// Part of ExplicitDynamics: the lists of pairs that may interact, how wide they reach and how long they serve.
namespace floc {
namespace {

/// What a new list of pairs costs, in time steps (measured at N = 1400 and 100 000).
constexpr double kListCost = 23.0;
/// What grains at rest get of the skin of the fastest: they may be hit.
constexpr double kMinSkinShare = 0.25;
/// In skin_length_unit().
constexpr double kMinSkin = 1e-4;
/// Skin of lists with which liquid is shared out, of the reach of the furthest bridge: two surfaces come nearer to
/// each other by that at most before it is shared out again.
constexpr double kSkinOfReach = 0.25;
constexpr double kMinSkinOfLiquid = 1e-3;
/// What the rounding of a step may add to a displacement, of the furthest coordinate.
constexpr double kRoundings = 32.0 * std::numeric_limits<double>::epsilon();

template <std::size_t n>
double furthest(const std::array<AlignedVector<double>, n>& x) {
  double largest = 0.0;
  for (const auto& component : x)
    for (const double coordinate : component) largest = std::max(largest, std::abs(coordinate));
  return largest;
}

/// Bound of how much an upper triangular matrix stretches a vector: its diagonal, and each other component alone.
template <int Dim>
double stretch_bound(const double (&matrix)[Dim][Dim]) {
  double diagonal = 0.0, others = 0.0;
  for (int a = 0; a < Dim; ++a) {
    diagonal = std::max(diagonal, std::abs(matrix[a][a]));
    for (int b = a + 1; b < Dim; ++b) others += std::abs(matrix[a][b]);
  }
  return diagonal + others;
}

}  // namespace

template <int Dim>
double ExplicitDynamics<Dim>::min_skin() const {
  return kMinSkin * skin_unit_;
}

/// The share of the time that the list has cost so far, against that of its pairs out of range: the
/// skin is right where the two are equal.
template <int Dim>
double ExplicitDynamics<Dim>::list_cost_share() const {
  return kListCost / steps_since_list_;
}

/// What motion has taken of the skin since the list was built, as far as it is known: the largest displacement in
/// halves of each grain's own skin, and the affine shrinking.
template <int Dim>
double ExplicitDynamics<Dim>::consumed_skin() const {
  return std::max(moved_ * skin_, 2.0 * cell_.walls().moved_since_mark()) +
         shrink_since_list() * (largest_diameter_ + interactions_.between_grains().range() + skin_) /
             kMinSkinShare;
}

/// Before the grains drift: x' - L' x_list = S (x - L x_list) + D v', where |v'| <= max(|keep|, |gain|) (|v| + |dt F/2m|)
/// after the kick. So lists mostly prove to be good without a look at every grain, and before it moves.
template <int Dim>
void ExplicitDynamics<Dim>::bound_motion() {
  double next_speed_squared = 0.0;
  for (const BlockSums<Dim>& s : sums_) next_speed_squared = std::max(next_speed_squared, s.next_speed_squared);
  const double kick = std::max(stretch_bound(kick_.keep), stretch_bound(kick_.gain));
  moved_ = stretch_bound(drift_.stretch) * moved_ + rounding_ +
           stretch_bound(drift_.drift) * kick * std::sqrt(next_speed_squared);
}

template <int Dim>
void ExplicitDynamics<Dim>::take_measured_motion() {
  moved_ = *std::max_element(motion_of_block_.begin(), motion_of_block_.end());
}

/// After the grains have drifted and the motion of each block has been measured.
template <int Dim>
void ExplicitDynamics<Dim>::renew_list() {
  take_measured_motion();
  if (list_is_stale()) rebuild_list();
}

/// Of the skin, for each grain: a list that all grains hold for the same time gives more to those that are
/// faster.
template <int Dim>
std::vector<double> ExplicitDynamics<Dim>::skin_shares() const {
  std::vector<double> speed(grains_.size());
  for (int k = 0; k < grains_.size(); ++k) {
    double squared = 0.0;
    for (int a = 0; a < Dim; ++a) squared += grains_.v[a][k] * grains_.v[a][k];
    speed[k] = std::sqrt(squared);
  }
  const double fastest = speed.empty() ? 0.0 : *std::max_element(speed.begin(), speed.end());
  const bool comparable = fastest > 0.0 && std::isfinite(fastest);  // not where the motion diverges
  for (double& share : speed) share = comparable ? std::max(share / fastest, kMinSkinShare) : 1.0;
  return speed;
}

/// Largest share by which the deformation since the list was built has shortened any line.
template <int Dim>
double ExplicitDynamics<Dim>::shrink_since_list() const {
  if (list_stretch_.isDiagonal(0.0)) return std::max(0.0, 1.0 - list_stretch_.diagonal().minCoeff());
  // |F r| >= |r| - |(F - 1) r|: a bound by the Frobenius norm.
  return (list_stretch_ - Mat<Dim>::Identity()).norm();
}

/// The list holds too many pairs out of range, or a pair outside it might interact, for all that is known of motion.
template <int Dim>
bool ExplicitDynamics<Dim>::list_is_stale() const {
  if (list_cost_share() < 0.5 * out_of_range_share_ && skin_ > min_skin() && !shares_liquid()) return true;
  return !(consumed_skin() < skin_);
}

template <int Dim>
void ExplicitDynamics<Dim>::adapt_skin() {
  if (shares_liquid()) {  // its skin decides when that happens, and must not follow what lists cost
    skin_ = std::clamp(kSkinOfReach * interactions_.between_grains().range(), kMinSkinOfLiquid * skin_unit_,
                       0.5 * largest_diameter_);
    return;
  }
  if (interactions_.between_grains().pairs().size() == 0 || steps_since_list_ == 0) return;
  on_first_list_ = false;
  const double cost = list_cost_share();
  if (cost > out_of_range_share_)
    skin_ = std::min((cost > 4.0 * out_of_range_share_ ? 2.0 : 1.25) * skin_, 0.5 * largest_diameter_);
  // Twice what motion consumed of a skin is enough for a list that lasts as long.
  if (cost < 0.5 * out_of_range_share_)
    skin_ = std::max(std::min(0.8 * skin_, 2.0 * consumed_skin()), min_skin());
}

/// The next chunk begins with a new list in any case: where one list has served for all of this one, twice
/// what motion consumed of its skin is enough.
template <int Dim>
double ExplicitDynamics<Dim>::skin() const {
  if (!on_first_list_ || steps_since_list_ == 0) return skin_;
  return std::min(skin_, std::max(2.0 * consumed_skin(), min_skin()));
}

/// Share of a step that goes into pairs out of each other's range: a grain costs about as much as a pair.
template <int Dim>
double ExplicitDynamics<Dim>::out_of_range_share(const std::vector<NeighborPair<Dim>>& pairs) const {
  std::size_t out_of_range = 0;
  for (const NeighborPair<Dim>& p : pairs) {
    const Vec<Dim> shift = cell_.image_shift(p.image);
    double squared = 0.0;
    for (int a = 0; a < Dim; ++a) {
      const double r = grains_.x[a][p.j] - grains_.x[a][p.i] + shift[a];
      squared += r * r;
    }
    const double reach = grains_.radius[p.i] + grains_.radius[p.j] + interactions_.between_grains().range();
    out_of_range += squared >= reach * reach;
  }
  return static_cast<double>(out_of_range) /
         static_cast<double>(pairs.size() + static_cast<std::size_t>(grains_.size()));
}

template <int Dim>
void ExplicitDynamics<Dim>::rebuild_list() {
  if (!finite()) return;  // the caller will ask; there are no neighbours to find
  if (bridges_)
    interactions_.between_grains().set_range(
        std::max(interactions_.between_grains().range(), reach_of_liquid()));
  build_lists(interactions_.further_contacts());
  if (shares_liquid()) spread_liquid();
}

template <int Dim>
void ExplicitDynamics<Dim>::build_lists(const PairLists<Dim>& further) {
  if (!finite()) return;
  adapt_skin();
  sums_of_rows_ = RowSums<Dim>();  // of the lists that end here
  auto close = close_pairs();
  out_of_range_share_ = out_of_range_share(close[0]);
  interactions_.set_pairs(std::move(close), further, grains_, dt_, blocks_of_group());
  std::vector<const PairArrays<Dim>*> lists;
  for (const Interaction<Dim>& interaction : interactions_) lists.push_back(&interaction.pairs());
  sweep_plan_ = {interactions_.between_grains().pairs(), n_blocks(), threads_, blocks_of_group()};
  sums_of_rows_ = {lists, interactions_.between_grains().rows(), grains_.size(), sweep_plan_};
  if (interactions_.with_walls()) {
    interactions_.on_walls().set_rows(sums_of_rows_.rows_with_walls());
    cell_.list_pairs_of_walls(interactions_.on_walls().pairs());
  }
  cell_.mark_walls();
  x_list_ = grains_.x;
  grain_view_ = grains_.view(x_list_, inverse_skin_squared_);
  lattice_at_list_ = cell_.lattice();
  list_stretch_.setIdentity();
  moved_ = 0.0;
  rounding_ = kRoundings * furthest(x_list_) / (0.5 * kMinSkinShare * skin_);
  steps_since_list_ = 0;
}

/// Those of each interaction, by grains whose skins are as wide as the skin of the list and their speeds make
/// them.
template <int Dim>
PairLists<Dim> ExplicitDynamics<Dim>::close_pairs() {
  Grains<Dim> now;  // positions and radii alone
  now.position.resize(grains_.size());
  now.radius.resize(grains_.size());
  grains_.copy_positions_to(now);
  const std::vector<double> share = skin_shares();
  inverse_skin_squared_.assign(grains_.x[0].size(), 0.0);
  for (int k = 0; k < grains_.size(); ++k) {
    const double skin = 0.5 * skin_ * share[k];
    now.radius[k] = grains_.radius[k] + skin;
    inverse_skin_squared_[k] = 1.0 / (skin * skin);
  }
  PairLists<Dim> close;
  for (const Interaction<Dim>& interaction : interactions_) close.push_back(close_pairs(interaction, now));
  return close;
}

/// Pairs that may interact before bodies have moved by their skins.
/// @param now  grains with their skins around them
template <int Dim>
std::vector<NeighborPair<Dim>> ExplicitDynamics<Dim>::close_pairs(const Interaction<Dim>& interaction,
                                                                  const Grains<Dim>& now) const {
  const double range = interaction.range();
  if (interaction.partner() == Partner::wall)
    return find_wall_pairs(cell_.walls().walls(), now, range + 0.5 * skin_);
  return find_pairs(search_cell(cell_.cell(), cell_.walls().walls(), largest_diameter_ + range + skin_), now,
                    range);
}

#define FLOC_INSTANTIATE(Dim)                                  \
  template double ExplicitDynamics<Dim>::skin() const;         \
  template bool ExplicitDynamics<Dim>::list_is_stale() const;  \
  template void ExplicitDynamics<Dim>::bound_motion();         \
  template void ExplicitDynamics<Dim>::take_measured_motion(); \
  template void ExplicitDynamics<Dim>::renew_list();           \
  template void ExplicitDynamics<Dim>::rebuild_list();         \
  template void ExplicitDynamics<Dim>::build_lists(const PairLists<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
