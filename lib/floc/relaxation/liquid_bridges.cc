#include "floc/relaxation/liquid_bridges.h"

#include <algorithm>
#include <optional>

#include "floc/contact/adhesion/capillary_adhesion.h"

namespace floc {
namespace {

/// Pairs are put on the lists of neighbours up to this multiple of the largest gap that a liquid bridge spans at
/// present. The margin makes it unlikely that the search for neighbours has to be repeated.
constexpr double kReachMargin = 1.05;

template <int Dim>
double gap_of(const NeighborPair<Dim>& pair, const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell) {
  const Vec<Dim> shift = cell.image_shift(pair.image);
  Vec<Dim> r;
  for (int a = 0; a < Dim; ++a) r[a] = grains.x[a][pair.j] - grains.x[a][pair.i] + shift[a];
  return r.norm() - (grains.radius[pair.i] + grains.radius[pair.j]);
}

}  // namespace

template <int Dim>
LiquidBridges<Dim>::LiquidBridges(const Law& law, const GrainArrays<Dim>& grains, bool keeps_shares)
    : law_(law), search_(*law_.liquid(), grains.of_grains(grains.radius)), keeps_shares_(keeps_shares) {}

template <int Dim>
double LiquidBridges<Dim>::first_reach(const Packing<Dim>& packing) const {
  const double reach = kReachMargin * interaction_range(packing);
  return keeps_shares_ ? reach : std::max(reach, search_.first_reach());
}

template <int Dim>
double LiquidBridges<Dim>::reach(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                                 const Interaction<Dim>& between_grains) const {
  const PairArrays<Dim>& pairs = between_grains.pairs();
  double reach = between_grains.range();
  for (int p = 0; p < pairs.size(); ++p)
    if (pairs.bridge_volume()[p] != 0.0)
      reach = std::max(reach, kReachMargin * gap_of(pairs.key(p), grains, cell));
  return reach;
}

/// Computes the share of the liquid that each listed pair gets.
template <int Dim>
LiquidShares LiquidBridges<Dim>::shares(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                                        const PairArrays<Dim>& pairs) const {
  const CapillaryAdhesion& law = *law_.liquid();
  return share_liquid_among(law, search_.liquid(), pairs.size(), [&](int p) -> std::optional<BridgeablePair> {
    if (pairs.padding(p)) return {};
    const double gap = gap_of(pairs.key(p), grains, cell);
    if (!may_hold_liquid(law, gap, pairs.bridge_volume()[p])) return {};
    return BridgeablePair{gap, 2.0 * reduced(grains.radius[pairs.i(p)], grains.radius[pairs.j(p)])};
  });
}

template <int Dim>
bool LiquidBridges<Dim>::share_out(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                                   Interaction<Dim>& between_grains) const {
  const LiquidShares found = shares(grains, cell, between_grains.pairs());
  std::copy(found.volume.begin(), found.volume.end(), between_grains.bridge_volume().begin());
  if (law_.liquid()->formation == BridgeFormation::gap) {
    const double range = between_grains.range(), wider = search_.wider(range, found);
    if (wider > range) {
      between_grains.set_range(wider);
      return false;
    }
    between_grains.set_range(std::min(range, kReachMargin * search_.reach_bound(found)));
  }
  between_grains.refresh_bridges();
  return true;
}

template class LiquidBridges<2>;
template class LiquidBridges<3>;

}  // namespace floc
