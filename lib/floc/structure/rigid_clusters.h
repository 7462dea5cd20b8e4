#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/structure/contact_changes.h"

namespace floc {

/// Groups of grains that moved nearly as rigid bodies between two states.
struct RigidClusters {
  std::vector<int> cluster;  ///< of each grain, numbered by size from the largest; -1: moved on its own
  std::vector<int> size;     ///< grains of each cluster, >= 2
  int n_stuck = 0;           ///< kept contacts in which nothing moved

  int n_clustered() const;  ///< grains in clusters
};

/// Grains joined by kept contacts in which nothing moved: the material points that touched before are within
/// tolerance * a of each other after, and the two grains turned alike to within `tolerance` (radians). A rigid
/// body that moves and turns satisfies both exactly; along a chain of contacts small differences add up, hence
/// "nearly". Needs the orientations of the grains, which packings of other programs may lack.
///
/// @param changes    from `before` to `after`
/// @param tolerance  in largest diameters a and radians, > 0; otherwise InputError
template <int Dim>
RigidClusters rigid_clusters(const Packing<Dim>& before, const Packing<Dim>& after,
                             const ContactChanges<Dim>& changes, double tolerance);

}  // namespace floc
