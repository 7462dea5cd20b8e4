#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/fitting/consolidation.h"
#include "floc/tables/fit_tables.h"
#include "plots/gnuplot.h"

namespace floc {

/// Curve and fitted law of `consolidation_plot`.
struct FittedConsolidation {
  ConsolidationCurve curve;  ///< curve of the only sample, or mean of several
  ConsolidationFit fit;
};

/// Fits the full law to the first loading of a sample, or to the mean of several samples.
FittedConsolidation fitted_consolidation(const std::vector<PathTable>& samples);

/// Plots 1/Phi against P* (Phi on the right axis): samples, their mean with errors, the law with its regimes, unloading
/// branches and their elastic lines dPhi/Phi = dP/B. B is computed from the state at the start of the branch if its
/// file lies beside the table, otherwise fitted to the branch.
/// @param samples  at least one
Plot consolidation_plot(const std::vector<PathTable>& samples, const FittedConsolidation& fitted);

/// Plots coordination numbers by sign of the normal force against P*, with filled symbols for loading and open ones for
/// unloading.
/// @throws InputError if a column of path.csv is missing
Plot coordination_plot(const CsvTable& path);

/// Returns the unit of stresses and moduli as gnuplot text: the SI unit, or in reduced units F_0/a for disks and
/// F_0/a^2 for spheres. Reduced units without cohesion have no force F_0 and are called "units of the state".
/// @param units  "reduced" or "SI"
std::string stress_unit(const std::string& units, int dimension, bool cohesive);

/// Moduli of a state and their bounds (stress). A bound that does not hold is NaN.
struct ModuliPoint {
  double P_star;
  double B, B_S, G, B_reuss, B_voigt, G_voigt;

  /// Sets bounds that do not hold to NaN. @param hold  whether the conditions of B_reuss <= B <= B_voigt hold
  /// @param stable  whether no eigenvalue of the stiffness matrix is negative, so that G <= G_voigt
  ModuliPoint with_bounds(bool hold, bool stable) const;
};

/// Returns the point of moduli that were solved for.
ModuliPoint moduli_point(double P_star, const Moduli& moduli);

/// Plots moduli and their bounds against P*, both logarithmic, with filled symbols for loading and open ones for
/// unloading.
/// @param unit  unit of the moduli, as text
Plot moduli_plot(const std::vector<ModuliPoint>& points, const std::string& unit);

}  // namespace floc
