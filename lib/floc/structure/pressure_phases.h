#pragma once

#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// A phase: all grains with positive pressure, or all grains with negative pressure. Grains of a phase that are
/// connected by interactions form a cluster.
struct PressurePhase {
  int n_grains = 0;
  double share = 0.0;       ///< number of grains of the phase divided by the number of all grains
  double mean = 0.0;        ///< mean pressure of the grains of the phase (stress)
  int n_clusters = 0;       ///< number of clusters (connected parts), including single grains
  int largest_cluster = 0;  ///< number of grains of the largest cluster
  /// Largest number of independent directions in which a cluster winds around the cell. If it is above 0, the phase
  /// percolates.
  int n_directions = 0;
};

/// The two phases of positive and negative particle pressure (docs/physics.md, "Force network"). Grains of
/// pressure zero are in neither phase.
struct PressurePhases {
  PressurePhase positive, negative;
};

/// Computes the two phases of positive and negative particle pressure.
/// @param pressure  pressure of each grain (stress)
template <int Dim>
PressurePhases pressure_phases(const ContactNetwork<Dim>& network, const std::vector<double>& pressure);

}  // namespace floc
