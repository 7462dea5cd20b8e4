#pragma once

#include <optional>
#include <vector>

#include "floc/fitting/loading_path.h"

namespace floc {

/// Returns the work that pressure does on a packing along a path, per unit volume of its grains (stress):
///
///   -integral of P d(1/Phi), by the trapezoidal rule between the points
///
/// Times the volume of a grain, pi a^3/6 for spheres, this is the work on a grain. For a cycle from P0 up and
/// back to P0 it is the integral of (1/Phi_up - 1/Phi_down) dP less P0 (1/Phi_end - 1/Phi_start).
double work_of_path(const ConsolidationCurve& path);

/// A loading and the unloading after it.
struct PressureCycle {
  Loading up;    ///< rows from the lowest pressure to the largest
  Loading down;  ///< rows from the largest pressure on
  /// Pressures that both have (to 0.1 %), ascending, without the turn, and Phi there. Phi_down - Phi_up is the
  /// compaction that the cycle leaves for good.
  std::vector<double> P, phi_up, phi_down;
  /// work_of_path() of both, from the lowest pressure that both have and back to it; absent if they have none
  /// in common.
  std::optional<double> work;
};

/// Returns the cycles of a path, one for each of unloadings() that follows a loading. Rows of held pressure
/// belong to the loading; P* = 0 is left out.
std::vector<PressureCycle> pressure_cycles(const std::vector<PathRow>& rows);

}  // namespace floc
