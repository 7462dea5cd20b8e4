#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/fitting/consolidation.h"
#include "floc/tables/fit_tables.h"
#include "plots/gnuplot.h"

namespace floc {

/// Curve and law of `consolidation_plot`.
struct FittedConsolidation {
  ConsolidationCurve curve;  ///< of the one sample, or the mean of several
  ConsolidationFit fit;
};

/// The full law fitted to the first loading of a sample, or to the mean of several.
FittedConsolidation fitted_consolidation(const std::vector<PathTable>& samples);

/// 1/Phi against P* (Phi on the right): samples, their mean with errors, the law with its regimes, unloading
/// branches and their elastic lines dPhi/Phi = dP/B, by the modulus of the state each starts from where it lies
/// beside the table, else by that of the branch.
/// @param samples  at least one
Plot consolidation_plot(const std::vector<PathTable>& samples, const FittedConsolidation& fitted);

/// Coordination numbers by sign of the normal force against P*; loading filled, unloading open symbols.
/// @throws InputError if a column of path.csv is missing
Plot coordination_plot(const CsvTable& path);

/// Unit of stresses and moduli as gnuplot writes it: that of SI, or F_0/a (F_0/a^2 of spheres) of reduced units,
/// which have a force F_0 where there is cohesion.
/// @param units  "reduced" or "SI"
std::string stress_unit(const std::string& units, int dimension, bool cohesive);

/// A state's moduli and their bounds (stress); NaN where they are none.
struct ModuliPoint {
  double P_star;
  double B, B_S, G, B_reuss, B_voigt, G_voigt;

  /// Takes away what is no bound. @param hold  whether B_reuss <= B <= B_voigt is a theorem
  /// @param stable  whether no eigenvalue of the stiffness matrix is negative: G <= G_voigt then
  ModuliPoint with_bounds(bool hold, bool stable) const;
};

/// The point of moduli that were solved for.
ModuliPoint moduli_point(double P_star, const Moduli& moduli);

/// Moduli against P*, both logarithmic, with what bounds them; loading filled, unloading open symbols.
/// @param unit  of the moduli, in words
Plot moduli_plot(const std::vector<ModuliPoint>& points, const std::string& unit);

}  // namespace floc
