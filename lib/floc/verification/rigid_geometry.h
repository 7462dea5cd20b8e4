#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Contacts of a packing of rigid grains, computed from positions and shapes and not from the recorded geometry.
template <int Dim>
struct RigidGeometry {
  /// The recorded contacts, with the recorded forces, but with gaps, normals and lever arms computed from positions and
  /// shapes. If no contact point of the two grains has the recorded key, the contact point nearest to the recorded
  /// point is used. If the grains have no contact point at all, the gap is infinite.
  std::vector<Contact<Dim>> recorded;
  /// Contacts between all surfaces that overlap by more than a tolerance, the deepest first. These contacts have no
  /// forces.
  std::vector<Contact<Dim>> overlapping;
  /// Deepest overlap of any two surfaces, divided by the diameter of the smaller grain.
  double deepest = 0.0;
};

/// Finds the contact points of a packing from positions and shapes. Overlaps above `gap_limit` and above `error` are
/// listed in RigidGeometry::overlapping.
/// @param gap_limit  largest gap of a contact, divided by the diameter of the smaller grain
/// @param error      rounding error of the gaps, divided by the diameter of the smaller grain. A contact keeps its
/// recorded type if points whose gap is at the limit, within this error, decide about the type
template <int Dim>
RigidGeometry<Dim> rigid_geometry(const Packing<Dim>& packing, double gap_limit, double error);

}  // namespace floc
