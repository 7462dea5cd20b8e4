#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/structure/contact_changes.h"

namespace floc {

/// Groups of grains that moved nearly as rigid bodies between two states.
struct RigidClusters {
  /// Index of the cluster of each grain, ordered by size from the largest; -1 if it is in no cluster.
  std::vector<int> cluster;
  std::vector<int> size;  ///< number of grains of each cluster, >= 2
  int n_stuck = 0;        ///< number of contacts without relative motion, within the tolerance

  int n_clustered() const;  ///< number of grains in clusters
};

/// Finds groups of grains joined by contacts that exist in both states and show no relative motion: the
/// material points that touched before are within tolerance * a of each other after, and the rotations of the
/// two grains differ by less than `tolerance` (radians). A rigid body that moves and rotates satisfies both
/// conditions exactly; along a chain of contacts small differences add up. Both packings must include the
/// orientations of the grains, which packings of other programs may lack.
///
/// @param changes    changes of contacts from `before` to `after`
/// @param tolerance  tolerance in largest diameters a and in radians, > 0; otherwise InputError
template <int Dim>
RigidClusters rigid_clusters(const Packing<Dim>& before, const Packing<Dim>& after,
                             const ContactChanges<Dim>& changes, double tolerance);

}  // namespace floc
