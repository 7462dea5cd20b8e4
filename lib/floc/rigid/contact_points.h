#pragma once

#include <vector>

#include "floc/neighbors/pairs.h"
#include "floc/packing/packing.h"
#include "floc/shape/separating_axis.h"

namespace floc {

/// Search for the contact points of a packing. Round grains have one point per pair, grains with corners up to two (2D)
/// or four (3D). The object remembers the features of each pair that defined the last separating axis, and the next
/// search begins with them; they change the points only within the margins of contact_manifold().
template <int Dim>
class ContactPoints {
 public:
  /// Returns the contact points whose gap is smaller than `reach` (length), in the order of the contacts of a packing,
  /// without forces.
  /// @throws InputError if find_pairs() throws it
  std::vector<Contact<Dim>> find(const Packing<Dim>& packing, double reach);

  /// Returns the contact points whose gap is smaller than `share` times the diameter of the smaller grain. For a face
  /// with many corners, find() with a larger reach may return other points.
  std::vector<Contact<Dim>> find_touching(const Packing<Dim>& packing, double share);

 private:
  struct KnownPair {
    NeighborPair<Dim> pair;
    AxisFeatures features;
  };
  std::vector<Contact<Dim>> find(const Packing<Dim>& packing, double reach, double share);

  std::vector<KnownPair> known_;  ///< pairs of the last search, in its order
};

/// Gives contact points the forces of earlier contact points. A point takes the forces of the earlier point with the
/// same key. Each remaining point of a pair of shapes takes the forces of the nearest earlier point of the pair
/// (matched_points()). Tangential forces are projected onto the new tangent planes.
/// @param before, now  contacts sorted like those of a packing
template <int Dim>
void carry_forces(const Packing<Dim>& packing, const std::vector<Contact<Dim>>& before,
                  std::vector<Contact<Dim>>& now);

}  // namespace floc
