#pragma once

#include <vector>

#include "floc/neighbors/pairs.h"
#include "floc/packing/packing.h"
#include "floc/shape/separating_axis.h"

namespace floc {

/// Search for the contact points of a packing. A pair of round grains has one point; a pair of grains with corners has
/// up to two (2D) or eight (3D). For each pair, the object stores the features (vertices, edges or faces) that defined
/// the separating axis in the last search. The next search begins with these features. Its result differs from that of
/// a search without stored features by no more than the margins of contact_manifold().
template <int Dim>
class ContactPoints {
 public:
  /// Returns the contact points whose gap is smaller than `reach` (length), sorted like the contacts of a packing. The
  /// forces of the points are zero.
  /// @throws InputError if find_pairs() throws it
  std::vector<Contact<Dim>> find(const Packing<Dim>& packing, double reach);

  /// Returns the contact points whose gap is smaller than `share` times the diameter of the smaller grain. If a face
  /// has many corners, the points may differ from those that find() returns for a larger reach.
  std::vector<Contact<Dim>> find_touching(const Packing<Dim>& packing, double share);

 private:
  struct KnownPair {
    NeighborPair<Dim> pair;
    AxisFeatures features;
  };
  std::vector<Contact<Dim>> find(const Packing<Dim>& packing, double reach, double share);

  std::vector<KnownPair> known_;  ///< pairs of the last search, in the order in which they were found
};

/// Returns the default value of ContactDynamicsOptions::gap_tolerance: 1e-4 for round grains, 1e-6 for polyhedra without
/// friction, whose equilibria are found exactly, and 1e-3 for other grains with corners.
template <int Dim>
double default_gap_tolerance(const Packing<Dim>& packing);

/// Gives contact points the forces of earlier contact points. A point gets the forces of the earlier point with the
/// same key. Each remaining point of a pair of shapes gets the forces of the nearest earlier point of the pair that is
/// not used yet (matched_points()). Tangential forces are projected onto the new tangent planes.
/// @param before, now  contacts, sorted like those of a packing
template <int Dim>
void carry_forces(const Packing<Dim>& packing, const std::vector<Contact<Dim>>& before,
                  std::vector<Contact<Dim>>& now);

}  // namespace floc
