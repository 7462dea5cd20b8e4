#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "floc/packing/packing.h"

/// Functions for packings whose contact law has liquid bridges. They find the pairs of grains that have a bridge, and
/// the volumes of the bridges.
namespace floc {

/// Estimated number of liquid bridges per grain in a dense packing. The search for bridges begins with this estimate.
/// Checks of a scene file also use it, because there are no bridges yet.
inline constexpr double kBridgesPerGrain = 3.0;

/// Pair of grains between which a liquid bridge may form.
struct BridgeablePair {
  double gap;     ///< gap h between the surfaces (length), negative or zero if they touch
  double radius;  ///< mean radius R' = 2 Ri Rj/(Ri + Rj) of the two grains (length)
};

/// Distribution of the liquid in a packing over a list of pairs of grains.
struct LiquidShares {
  std::vector<double> volume;  ///< volume V_b of the bridge of each pair (length^3), 0 without a bridge
  int n_bonds = 0;             ///< number of pairs with a bridge
  double radius_sum = 0.0;     ///< sum of the mean radii R' of all pairs with a bridge (length)
};

/// Distributes a volume V_l of liquid over pairs of grains. A pair has a bridge if its surfaces touch or if its gap h
/// is at most the reach (1 + th/2) V_b^(1/3) of its bridge, where V_b is the volume of the bridge and th the contact
/// angle. V_b is proportional to the mean radius R' of the pair: V_b = V_l R'/sum R', with the sum over all pairs that
/// have a bridge. The condition for a bridge and the formula for V_b together determine which pairs have bridges. The
/// pairs are sorted by
///
///   q = R' (1 + th/2)^3/h^3 (infinite if the surfaces touch), the largest first.
///
/// Let S_k be the sum of R' over the first k pairs. The first k pairs have bridges, where k is the largest number with
/// S_k <= V_l q_k (S_k rises with k, and q_k falls). The gap of each of these pairs is within the reach of its bridge;
/// with any larger k, the gap of some pair would be too wide. (If the values R' differ, there may be other choices with
/// more pairs, which leave out a pair with a larger q.) Pairs of equal q keep their order. The volumes add up to V_l,
/// up to rounding; if no pair is within reach, all volumes are zero.
///
/// @param liquid  volume V_l of the liquid (length^3), > 0
LiquidShares share_liquid(const CapillaryAdhesion& bridges, double liquid,
                          std::span<const BridgeablePair> pairs);

/// Returns whether a pair of grains may get liquid. If bridges form only on contact, the grains have to touch or to
/// have a bridge already.
/// @param gap  gap between the grains (length)
/// @param volume  volume of their bridge (length^3)
bool may_hold_liquid(const CapillaryAdhesion& bridges, double gap, double volume);

/// Distributes the volume `liquid` (length^3) over n pairs of grains, except the pairs that cannot get liquid.
/// @param pair  function that returns the pair number k; it returns no value if this pair gets no liquid
/// @return distribution with the volumes of all n pairs; the volume of an excepted pair is 0
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

/// Search for the pairs of grains that have liquid bridges. All pairs up to some gap are considered, and the gap is
/// widened until no pair with a larger gap can have a bridge.
class BridgeSearch {
 public:
  /// @param radius  radius of each grain (length)
  BridgeSearch(const CapillaryAdhesion& bridges, std::span<const double> radius);

  /// Returns the total volume of liquid (length^3).
  double liquid() const { return liquid_; }
  /// Returns the gap (length) up to which pairs are considered first: the largest reach of a bridge if there were
  /// kBridgesPerGrain bridges per grain.
  double first_reach() const;
  /// Returns an upper bound on the reach (length) of each bridge in the distribution `shares`.
  double reach_bound(const LiquidShares& shares) const;
  /// Returns the next gap (length) up to which pairs are considered, where `shares` is the distribution over all pairs
  /// closer than `reach`. The next gap is wider than `reach`, or equal to `reach` if the distribution is final.
  double wider(double reach, const LiquidShares& shares) const;

 private:
  const CapillaryAdhesion& bridges_;
  double liquid_, largest_radius_;
  /// Estimated sum of the mean radii R' of all bridges, for kBridgesPerGrain bridges per grain (length).
  double radius_sum_;
};

/// Returns whether the contact law of a packing has liquid. If so, the history of the contacts contains the volumes of
/// the bridges.
template <int Dim>
bool holds_liquid(const Packing<Dim>& packing) {
  return packing.law.liquid() != nullptr;
}

/// Returns the volume of the liquid at a contact (length^3), as stored in the history: negative if the liquid bridge
/// has broken. The result is 0 if the contact law has no liquid.
template <int Dim>
double bridge_volume(const Packing<Dim>& packing, const Contact<Dim>& contact);
/// Sets the volume of the liquid at a contact (length^3).
/// @pre the contact law has liquid
template <int Dim>
void set_bridge_volume(double volume, Contact<Dim>& contact);

/// Returns whether a pair of grains belongs in the list of contacts. This is the case if the surfaces touch or attract
/// each other across a gap, or if there is liquid between them.
/// @pre contact.distant is set: whether the surfaces attract each other across a gap
template <int Dim>
bool interacts(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return !contact.distant || contact.gap < packing.law.range() || bridge_volume(packing, contact) != 0.0;
}

/// Returns the largest gap (length) at which the surfaces of a contact act on each other: the reach of the contact law
/// or, with liquid, the reach of the liquid bridge.
template <int Dim>
double range_of(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns the largest gap (length) at which any contact of a packing acts. It is the maximum of three lengths: the
/// reach of the contact law, the reaches of all liquid bridges, and the gaps of all contacts that have liquid.
template <int Dim>
double interaction_range(const Packing<Dim>& packing);

/// Returns the pull-off force F0 between two grains of the largest radius in a packing (force); 0 without adhesion.
template <int Dim>
double pull_off_force(const Packing<Dim>& packing);

/// Returns the pull-off force F0 of a contact whose surfaces touch (force); 0 if no adhesion acts between them.
template <int Dim>
double pull_off_force(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns the total volume of spheres with these radii (length^3). In 2D, the disks represent a layer of spheres.
double volume_of_spheres(std::span<const double> radius);

}  // namespace floc
