#pragma once

#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Grains whose pressures have the same sign, joined where two of them interact.
struct PressurePhase {
  int n_grains = 0;
  double share = 0.0;       ///< number of its grains over that of all grains
  double mean = 0.0;        ///< mean pressure of its grains (stress)
  int n_clusters = 0;       ///< connected parts, single grains included
  int largest_cluster = 0;  ///< grains
  /// Independent ways in which one of its parts winds around the cell: it percolates if > 0.
  int n_directions = 0;
};

/// The two phases of positive and negative particle pressure (docs/physics.md, "Force network"). Grains of
/// pressure zero are in neither.
struct PressurePhases {
  PressurePhase positive, negative;
};

/// Computes the two phases. @param pressure  of each grain of the network (stress)
template <int Dim>
PressurePhases pressure_phases(const ContactNetwork<Dim>& network, const std::vector<double>& pressure);

}  // namespace floc
