#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/structure/contact_changes.h"

namespace floc {

/// Groups of grains that move nearly as rigid bodies from one state to another.
struct RigidClusters {
  /// Index of the cluster of each grain, -1 for a grain in no cluster. Clusters are numbered by size, the largest
  /// first.
  std::vector<int> cluster;
  std::vector<int> size;  ///< number of grains of each cluster, >= 2
  /// Number of contacts whose two grains did not move relative to each other, within the tolerance.
  int n_stuck = 0;

  int n_clustered() const;  ///< number of grains in clusters
};

/// Finds groups of grains that are joined by contacts without relative motion. A contact has no relative motion if it
/// exists in both states and satisfies two conditions. First, the two material points that touch in the state before
/// have a distance of at most tolerance * a in the state after, where a is the largest diameter. Second, the rotations
/// of the two grains differ by at most `tolerance` (radians). Within a moving and rotating rigid body, both differences
/// are exactly zero. Along a chain of contacts, differences below the tolerance may add up. Both packings must contain
/// the orientations of the grains; packings from other programs may lack them.
///
/// @param changes    changes of contacts from `before` to `after`
/// @param tolerance  largest relative displacement (in units of the largest diameter) and largest relative rotation
///                   (radians) of two grains that count as no motion; > 0, otherwise InputError
template <int Dim>
RigidClusters rigid_clusters(const Packing<Dim>& before, const Packing<Dim>& after,
                             const ContactChanges<Dim>& changes, double tolerance);

}  // namespace floc
