// The liquid bridges of ExplicitDynamics: how far its lists look for them, and how their liquid is shared out.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "floc/contact/adhesion/capillary_adhesion.h"
#include "floc/relaxation/explicit_dynamics.h"

namespace floc {
namespace {

/// How much further lists look than bridges reach now, so that one search is enough next time.
constexpr double kReachMargin = 1.05;

}  // namespace

/// Lists hold every pair with liquid on it, and those that may get some.
template <int Dim>
void ExplicitDynamics<Dim>::set_first_reach(const Packing<Dim>& packing) {
  bridges_.emplace(*law_.liquid(), grains_.of_grains(grains_.radius));
  const double reach = kReachMargin * interaction_range(packing);
  interactions_.between_grains().set_range(holds_liquid_ ? reach : std::max(reach, bridges_->first_reach()));
}

/// The widest gap with liquid on it.
template <int Dim>
double ExplicitDynamics<Dim>::reach_of_liquid() const {
  const PairArrays<Dim>& pairs = interactions_.between_grains().pairs();
  double reach = 0.0;
  for (int p = 0; p < pairs.size(); ++p)
    if (pairs.bridge_volume()[p] != 0.0) reach = std::max(reach, kReachMargin * gap_of(pairs.key(p)));
  return reach;
}

template <int Dim>
double ExplicitDynamics<Dim>::gap_of(const NeighborPair<Dim>& pair) const {
  const Vec<Dim> shift = cell_.image_shift(pair.image);
  Vec<Dim> r;
  for (int a = 0; a < Dim; ++a) r[a] = grains_.x[a][pair.j] - grains_.x[a][pair.i] + shift[a];
  return r.norm() - (grains_.radius[pair.i] + grains_.radius[pair.j]);
}

/// The liquid of all shared out over the pairs of the list.
template <int Dim>
LiquidShares ExplicitDynamics<Dim>::share_liquid() {
  const CapillaryAdhesion& law = *law_.liquid();
  const PairArrays<Dim>& pairs = interactions_.between_grains().pairs();
  LiquidShares shares =
      share_liquid_among(law, bridges_->liquid(), pairs.size(), [&](int p) -> std::optional<BridgeablePair> {
        if (pairs.padding(p)) return {};
        const double gap = gap_of(pairs.key(p));
        if (!may_hold_liquid(law, gap, pairs.bridge_volume()[p])) return {};
        return BridgeablePair{gap, 2.0 * reduced(grains_.radius[pairs.i(p)], grains_.radius[pairs.j(p)])};
      });
  std::copy(shares.volume.begin(), shares.volume.end(), interactions_.between_grains().bridge_volume().begin());
  return shares;
}

/// Shares the liquid out, over a list that reaches far enough.
template <int Dim>
void ExplicitDynamics<Dim>::spread_liquid() {
  Interaction<Dim>& grains = interactions_.between_grains();
  LiquidShares shares = share_liquid();
  if (law_.liquid()->formation == BridgeFormation::gap) {
    for (double wider = bridges_->wider(grains.range(), shares); wider > grains.range();
         wider = bridges_->wider(grains.range(), shares)) {
      grains.set_range(wider);
      build_lists(interactions_.further_contacts());
      shares = share_liquid();
    }
    grains.set_range(std::min(grains.range(), kReachMargin * bridges_->reach_bound(shares)));
  }
  grains.refresh_bridges();
}

#define FLOC_INSTANTIATE(Dim)                                                \
  template void ExplicitDynamics<Dim>::set_first_reach(const Packing<Dim>&); \
  template double ExplicitDynamics<Dim>::reach_of_liquid() const;            \
  template void ExplicitDynamics<Dim>::spread_liquid();
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
