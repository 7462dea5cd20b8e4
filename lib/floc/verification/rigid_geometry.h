#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Contacts of a packing of rigid grains as they follow from positions and shapes, without the recorded geometry.
template <int Dim>
struct RigidGeometry {
  /// For each recorded contact, that contact with the gap, normal and lever arms that were found, and the recorded
  /// forces. Where the pair has no contact point with the recorded key, this is its contact point nearest to the
  /// recorded one; where it has no contact point at all, the gap is infinite.
  std::vector<Contact<Dim>> recorded;
  /// Overlaps deeper than a tolerance, between any two surfaces, deepest first. They have no forces.
  std::vector<Contact<Dim>> overlapping;
  /// Deepest overlap of any two surfaces, over the diameter of the smaller grain.
  double deepest = 0.0;
};

/// Finds the contact points of a packing from positions and shapes.
/// @param tolerance  overlap from which a contact is listed in RigidGeometry::overlapping, over the diameter of the
/// smaller grain
template <int Dim>
RigidGeometry<Dim> rigid_geometry(const Packing<Dim>& packing, double tolerance);

}  // namespace floc
