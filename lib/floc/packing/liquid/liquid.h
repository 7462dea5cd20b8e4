#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "floc/packing/packing.h"

/// Liquid of a packing whose law has capillary bridges: the pairs that hold it and their volumes.
namespace floc {

/// Bridges per grain of a dense packing, each shared by two grains. A search begins with this number, and a
/// scene assumes it before there are any bridges.
inline constexpr double kBridgesPerGrain = 3.0;

/// Pair of grains that liquid may bridge.
struct BridgeablePair {
  double gap;     ///< h (length), negative or zero where the surfaces touch
  double radius;  ///< R' = 2 Ri Rj/(Ri + Rj) (length)
};

/// Distribution of the liquid over pairs.
struct LiquidShares {
  std::vector<double> volume;  ///< V_b of each pair (length^3), 0 without a bridge
  int n_bonds = 0;             ///< pairs with a bridge
  double radius_sum = 0.0;     ///< sum of R' over the pairs with a bridge (length)
};

/// Shares liquid out over pairs, V_b = V_l R'/sum R' over the bridged pairs. A pair is bridged if it touches or
/// is within the reach of its bridge. Volumes and bridged pairs follow from these two conditions: with
///
///   q = R' (1 + th/2)^3/h^3 (infinite where surfaces touch), sorted descending, S_k the running sum of R',
///
/// the first k pairs are bridged, where k is the largest number with S_k <= V_l q_k (S rises and q falls). All
/// of them are in reach at their own volumes, and this holds for no larger k. (A set that leaves out a pair of
/// larger q may have more members where the R' differ.) Pairs of equal q keep their order. The volumes add up
/// to V_l, up to rounding; if no pair is in reach, all volumes are zero.
///
/// @param liquid  V_l (length^3), > 0
LiquidShares share_liquid(const CapillaryAdhesion& bridges, double liquid,
                          std::span<const BridgeablePair> pairs);

/// Whether a pair with this gap (length) and this bridge volume (length^3) may get liquid. Where bridges form
/// on contact alone, the pair has to touch or to have a bridge.
bool may_hold_liquid(const CapillaryAdhesion& bridges, double gap, double volume);

/// Shares liquid out over n pairs, of which some may take no part.
/// @param pair  called with k; returns the k-th pair, or nothing if it takes no part
/// @return shares with the volumes of all n pairs
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

/// Gaps for the search of pairs that liquid may bridge: the search is widened until no pair beyond it can be in
/// reach.
class BridgeSearch {
 public:
  /// @param radius  of the grains
  BridgeSearch(const CapillaryAdhesion& bridges, std::span<const double> radius);

  /// V_l, volume of all liquid (length^3).
  double liquid() const { return liquid_; }
  /// First gap to search across (length): the reach of bridges if there were kBridgesPerGrain of them per
  /// grain.
  double first_reach() const;
  /// Upper bound of the reach of a bridge with the volumes of `shares` (length).
  double reach_bound(const LiquidShares& shares) const;
  /// Next gap to search across (length), given the shares over all pairs closer than `reach`: wider than
  /// `reach`, or `reach` itself if the shares are final.
  double wider(double reach, const LiquidShares& shares) const;

 private:
  const CapillaryAdhesion& bridges_;
  double liquid_, largest_radius_;
  double radius_sum_;  ///< sum of R' of kBridgesPerGrain bridges per grain (length)
};

/// Whether the law of a packing has liquid, so that the history of contacts holds bridge volumes.
template <int Dim>
bool holds_liquid(const Packing<Dim>& packing) {
  return packing.law.liquid() != nullptr;
}

/// Volume of the liquid at a contact (length^3), signed as in the history: negative for a bridge that has
/// broken. 0 under a law without liquid.
template <int Dim>
double bridge_volume(const Packing<Dim>& packing, const Contact<Dim>& contact);
/// Sets the volume of the liquid at a contact (length^3). @pre the law has liquid
template <int Dim>
void set_bridge_volume(double volume, Contact<Dim>& contact);

/// Whether a pair belongs to the contact list: it touches, attracts across its gap or holds liquid. @pre the
/// flag `distant` is set
template <int Dim>
bool interacts(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return !contact.distant || contact.gap < packing.law.range() || bridge_volume(packing, contact) != 0.0;
}

/// Gap beyond which a contact does not act (length): the reach of the law, or the reach of its bridge.
template <int Dim>
double range_of(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Largest gap at which any contact of a packing acts (length): the reach of the law or, with liquid, the
/// largest reach of a bridge and gap of a contact that holds liquid.
template <int Dim>
double interaction_range(const Packing<Dim>& packing);

/// Pull-off force F0 of two grains of the largest radius of a packing (force); 0 without adhesion.
template <int Dim>
double pull_off_force(const Packing<Dim>& packing);

/// Pull-off force F0 of a contact that touches (force); 0 where no adhesion acts between its surfaces.
template <int Dim>
double pull_off_force(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Volume of the grains as spheres (length^3); in 2D, disks stand for a layer of spheres.
double volume_of_spheres(std::span<const double> radius);

}  // namespace floc
