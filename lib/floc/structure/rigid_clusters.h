#pragma once

#include <vector>

#include "floc/packing/packing.h"
#include "floc/structure/contact_changes.h"

namespace floc {

/// Groups of grains that moved nearly as rigid bodies between two states.
struct RigidClusters {
  std::vector<int> cluster;  ///< cluster of each grain, numbered by size from the largest; -1: none
  std::vector<int> size;     ///< number of grains of each cluster, >= 2
  int n_stuck = 0;           ///< number of kept contacts without relative motion, within the tolerance

  int n_clustered() const;  ///< grains in clusters
};

/// Finds groups of grains joined by kept contacts without relative motion: the material points that touched
/// before are within tolerance * a of each other after, and the rotations of the two grains agree within
/// `tolerance` (radians). A rigid body that moves and turns satisfies both exactly; along a chain of contacts
/// small differences add up. The packings must have the orientations of the grains, which those of other
/// programs may lack.
///
/// @param changes    from `before` to `after`
/// @param tolerance  in largest diameters a and radians, > 0; otherwise InputError
template <int Dim>
RigidClusters rigid_clusters(const Packing<Dim>& before, const Packing<Dim>& after,
                             const ContactChanges<Dim>& changes, double tolerance);

}  // namespace floc
