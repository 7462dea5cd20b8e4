#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "floc/packing/packing.h"

/// The liquid of a packing whose law has capillary bridges: which pairs hold some, and how much.
namespace floc {

/// Bridges per grain of a dense packing, each shared by two grains: where a search begins, and what is assumed
/// of a scene before there are any.
inline constexpr double kBridgesPerGrain = 3.0;

/// A pair that liquid may bridge.
struct BridgeablePair {
  double gap;     ///< h (length), negative or zero where the surfaces touch
  double radius;  ///< R' = 2 Ri Rj/(Ri + Rj) (length)
};

/// How liquid is shared out.
struct LiquidShares {
  std::vector<double> volume;  ///< V_b of each pair, 0 for those without a bridge
  int n_bonds = 0;             ///< pairs with a bridge
  double radius_sum = 0.0;     ///< sum of R' over them (length)
};

/// Shares liquid out over pairs, V_b = V_l R'/sum R' over those that are bridged, which are those that touch or
/// are within the reach of their bridge. These two conditions fix both: with
///
///   q = R' (1 + th/2)^3/h^3 (infinite where surfaces touch), sorted descending, S_k the running sum of R',
///
/// the first k pairs are bridged, k the largest with S_k <= V_l q_k: S rises and q falls. All of them are in
/// reach at their own volumes, and for no larger k is this so. (A set that leaves out a pair of larger q, which
/// is reached more easily, may be larger where the R' differ.) Pairs of equal q keep their order. The volumes
/// add up to V_l, up to rounding; where no pair is in reach, none holds any.
///
/// @param liquid  V_l (length^3), > 0
LiquidShares share_liquid(const CapillaryAdhesion& bridges, double liquid,
                          std::span<const BridgeablePair> pairs);

/// Whether liquid may flow to a pair with this gap (length) that holds this volume (length^3): where bridges
/// form on contact alone, the pair has to touch or to have a bridge.
bool may_hold_liquid(const CapillaryAdhesion& bridges, double gap, double volume);

/// Shares liquid out over those of n pairs that may take part.
///
/// @param pair  the k-th pair, nothing where it takes no part
/// @return      volumes of all n pairs
template <class PairAt>
LiquidShares share_liquid_among(const CapillaryAdhesion& bridges, double liquid, int n, const PairAt& pair) {
  std::vector<BridgeablePair> taking_part;
  std::vector<int> place;
  for (int k = 0; k < n; ++k)
    if (const std::optional<BridgeablePair> found = pair(k)) {
      taking_part.push_back(*found);
      place.push_back(k);
    }
  LiquidShares shares = share_liquid(bridges, liquid, taking_part);
  std::vector<double> volume(n, 0.0);
  for (std::size_t p = 0; p < place.size(); ++p) volume[place[p]] = shares.volume[p];
  shares.volume = std::move(volume);
  return shares;
}

/// Where to look for pairs that liquid may bridge: wider and wider, until none further off can be in reach.
class BridgeSearch {
 public:
  /// @param radius  of the grains
  BridgeSearch(const CapillaryAdhesion& bridges, std::span<const double> radius);

  /// V_l, all the liquid there is.
  double liquid() const { return liquid_; }
  /// Gap to look across at first: the reach of bridges if there were kBridgesPerGrain of them per grain.
  double first_reach() const;
  /// No bridge reaches further than this as long as the volumes of `shares` hold.
  double reach_bound(const LiquidShares& shares) const;
  /// A wider gap to look across if the shares over all pairs closer than `reach` are not final yet, `reach`
  /// itself if they are.
  double wider(double reach, const LiquidShares& shares) const;

 private:
  const CapillaryAdhesion& bridges_;
  double liquid_, largest_radius_;
  double radius_sum_;  ///< of three bridges per grain
};

/// Whether contacts remember bridge volumes under the law of a packing.
template <int Dim>
bool holds_liquid(const Packing<Dim>& packing) {
  return packing.law.liquid() != nullptr;
}

/// Volume of the liquid at a contact, with the sign that it has in history: negative for a bridge that has
/// broken. 0 under a law that holds none.
template <int Dim>
double bridge_volume(const Packing<Dim>& packing, const Contact<Dim>& contact);
/// Sets it. @pre the law holds liquid
template <int Dim>
void set_bridge_volume(double volume, Contact<Dim>& contact);

/// Whether a contact, or a pair that might be one, acts or holds liquid at its gap. Its flag `distant` has to say
/// already whether the surfaces touch.
template <int Dim>
bool interacts(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return !contact.distant || contact.gap < packing.law.range() || bridge_volume(packing, contact) != 0.0;
}

/// Gap at which a contact ceases to act: the reach of the law, or that of its bridge (length).
template <int Dim>
double range_of(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Largest gap at which any contact of a packing acts: the reach of its law, or with liquid the reach of any
/// bridge and the gap of any contact that holds liquid (length).
template <int Dim>
double interaction_range(const Packing<Dim>& packing);

/// F0 of a packing: that of two of its largest grains. 0 without adhesion.
template <int Dim>
double pull_off_force(const Packing<Dim>& packing);

/// F0 of a contact that touches; 0 where no adhesion acts between its surfaces.
template <int Dim>
double pull_off_force(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Volume of the grains as spheres; in 2D, disks stand for a layer of them.
double volume_of_spheres(std::span<const double> radius);

}  // namespace floc
