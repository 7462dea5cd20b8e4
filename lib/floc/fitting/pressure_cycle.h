#pragma once

#include <optional>
#include <vector>

#include "floc/fitting/loading_path.h"

namespace floc {

/// Returns the work that the pressure does on a packing along a load path, divided by the volume of the grains
/// (stress). With the pressure P and the solid fraction Phi, this work is
///
///   -integral of P d(1/Phi), by the trapezoidal rule between the points
///
/// The work per grain is this work times the volume of a grain (pi a^3/6 for a sphere of diameter a). For a cycle that
/// starts and ends at the pressure P0, the work is the integral of (1/Phi_up - 1/Phi_down) dP minus P0 (1/Phi_end -
/// 1/Phi_start), where Phi_up and Phi_down are the solid fractions on loading and unloading.
double work_of_path(const ConsolidationCurve& path);

/// A loading and the unloading that follows it.
struct PressureCycle {
  Loading up;    ///< rows from the lowest pressure to the largest
  Loading down;  ///< rows from the largest pressure on
  /// Pressures common to loading and unloading (to 0.1 %), in ascending order and without the largest pressure, and the
  /// solid fractions at these pressures: phi_up on loading, phi_down on unloading. The difference phi_down - phi_up is
  /// the compaction that remains after the cycle.
  std::vector<double> P, phi_up, phi_down;
  /// Work of the cycle by work_of_path(). The cycle starts and ends at the lowest pressure common to loading and
  /// unloading. Without a common pressure, the work is absent.
  std::optional<double> work;
};

/// Returns the pressure cycles of a load path: one for each unloading (see unloadings()) that follows a loading. Rows
/// at constant pressure belong to the loading. Rows with P* = 0 are left out.
std::vector<PressureCycle> pressure_cycles(const std::vector<PathRow>& rows);

}  // namespace floc
