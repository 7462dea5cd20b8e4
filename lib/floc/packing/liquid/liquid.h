#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "floc/packing/packing.h"

/// Liquid of a packing whose contact law has capillary bridges: the pairs of grains that hold liquid, and its
/// volumes.
namespace floc {

/// Estimated number of liquid bridges per grain of a dense packing, where each bridge is shared by two grains.
/// A search for bridges begins with this number, and a scene assumes it before there are any bridges.
inline constexpr double kBridgesPerGrain = 3.0;

/// Pair of grains that a liquid bridge may connect.
struct BridgeablePair {
  double gap;     ///< gap h between the surfaces (length), negative or zero if they touch
  double radius;  ///< mean radius R' = 2 Ri Rj/(Ri + Rj) (length)
};

/// Distribution of the liquid of a packing over pairs of grains.
struct LiquidShares {
  std::vector<double> volume;  ///< volume V_b of the bridge of each pair (length^3), 0 without a bridge
  int n_bonds = 0;             ///< number of pairs with a bridge
  double radius_sum = 0.0;     ///< sum of the mean radii R' of all pairs with a bridge (length)
};

/// Distributes a volume V_l of liquid over pairs of grains in proportion to their mean radius R': V_b = V_l
/// R'/sum R' is the volume of the bridge of a pair, with the sum over the pairs that have a bridge. A pair has
/// a bridge if it touches or if its gap h is within the reach of its bridge. Volumes and bridges follow from
/// these two conditions: with
///
///   q = R' (1 + th/2)^3/h^3 (infinite if the surfaces touch), sorted descending, S_k the running sum of R',
///
/// the first k pairs have bridges, where k is the largest number with S_k <= V_l q_k (S rises and q falls) and
/// th is the contact angle. All of these pairs are within reach at their own volumes, and this holds for no
/// larger k. (If the R' differ, a set that leaves out a pair of larger q may have more members.) Pairs of equal
/// q keep their order. The volumes add up to V_l, up to rounding; if no pair is within reach, all volumes are
/// zero.
///
/// @param liquid  V_l (length^3), > 0
LiquidShares share_liquid(const CapillaryAdhesion& bridges, double liquid,
                          std::span<const BridgeablePair> pairs);

/// Returns whether a pair with this gap (length) and this bridge volume (length^3) may get liquid. If bridges
/// form only on contact, the pair has to touch or to have a bridge already.
bool may_hold_liquid(const CapillaryAdhesion& bridges, double gap, double volume);

/// Distributes the liquid over those of n pairs that may hold liquid.
/// @param pair  function of k that returns the k-th pair, or nothing if this pair gets no liquid
/// @return distribution with the volumes of all n pairs
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

/// Sequence of gaps for the search of pairs that liquid may bridge. The gap is widened until no pair beyond it
/// can be within reach of a bridge.
class BridgeSearch {
 public:
  /// @param radius  radius of each grain (length)
  BridgeSearch(const CapillaryAdhesion& bridges, std::span<const double> radius);

  /// Returns the total volume of liquid (length^3).
  double liquid() const { return liquid_; }
  /// Returns the first gap up to which pairs are searched (length): the reach of the bridges if there were
  /// kBridgesPerGrain bridges per grain.
  double first_reach() const;
  /// Returns an upper bound of the reach (length) of a bridge in the distribution `shares`.
  double reach_bound(const LiquidShares& shares) const;
  /// Returns the next gap up to which pairs are searched (length), where `shares` is the distribution over all
  /// pairs closer than `reach`. It is wider than `reach`, or equal to `reach` if the distribution is final.
  double wider(double reach, const LiquidShares& shares) const;

 private:
  const CapillaryAdhesion& bridges_;
  double liquid_, largest_radius_;
  /// Sum of the mean radii R' of all bridges if there were kBridgesPerGrain of them per grain (length).
  double radius_sum_;
};

/// Returns whether the contact law of a packing has liquid, so that the history of contacts holds the volumes
/// of bridges.
template <int Dim>
bool holds_liquid(const Packing<Dim>& packing) {
  return packing.law.liquid() != nullptr;
}

/// Returns the volume of the liquid at a contact (length^3), with the sign that it has in the history: negative
/// for a bridge that has broken. 0 under a law without liquid.
template <int Dim>
double bridge_volume(const Packing<Dim>& packing, const Contact<Dim>& contact);
/// Sets the volume of the liquid at a contact (length^3). @pre the law has liquid
template <int Dim>
void set_bridge_volume(double volume, Contact<Dim>& contact);

/// Returns whether a pair belongs to the list of contacts: it touches, attracts across its gap or holds liquid.
/// @pre the flag `distant` is set
template <int Dim>
bool interacts(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return !contact.distant || contact.gap < packing.law.range() || bridge_volume(packing, contact) != 0.0;
}

/// Returns the gap (length) beyond which a contact does not act: the reach of the law, or the reach of its
/// liquid bridge.
template <int Dim>
double range_of(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns the largest gap at which any contact of a packing acts (length): the reach of the law or, with
/// liquid, the largest reach of a bridge and gap of a contact that holds liquid.
template <int Dim>
double interaction_range(const Packing<Dim>& packing);

/// Returns the pull-off force F0 of two grains of the largest radius of a packing (force); 0 without adhesion.
template <int Dim>
double pull_off_force(const Packing<Dim>& packing);

/// Returns the pull-off force F0 of a contact that touches (force); 0 if no adhesion acts between its surfaces.
template <int Dim>
double pull_off_force(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns the total volume of the grains as spheres (length^3); in 2D, disks stand for a layer of spheres.
double volume_of_spheres(std::span<const double> radius);

}  // namespace floc
