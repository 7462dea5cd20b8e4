#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/fitting/consolidation.h"
#include "floc/tables/fit_tables.h"
#include "plots/gnuplot.h"

namespace floc {

/// A consolidation curve and the law fitted to it, for consolidation_plot().
struct FittedConsolidation {
  ConsolidationCurve curve;  ///< curve of the sample, or the mean curve of several samples
  ConsolidationFit fit;
};

/// Fits the form of the consolidation law that the data support. The law is fitted to the first loading of a sample or,
/// for several samples, to the mean of their first loadings.
FittedConsolidation fitted_consolidation(const std::vector<PathTable>& samples, double phi_limit = 1.0);

/// Plots 1/Phi against P*, with Phi (solid fraction) on the right axis. The plot shows the samples, their mean with its
/// error, the fitted law with its regimes, and the unloading branches with their elastic lines dPhi/Phi = dP/B. The
/// modulus B is that of the state at the start of the unloading branch, if the directory of path.csv contains the file
/// of this state. Otherwise B is fitted to the branch.
/// @param samples  load paths of the samples; at least one
Plot consolidation_plot(const std::vector<PathTable>& samples, const FittedConsolidation& fitted);

/// Plots four coordination numbers against P*: those of all contacts and of the contacts with positive, negative and
/// zero normal force. Filled symbols are for loading and open symbols for unloading.
/// @throws InputError if a column of path.csv is missing
Plot coordination_plot(const CsvTable& path);

/// Returns the unit of stresses and moduli as gnuplot text. In SI units, this is the SI unit of the stress. In reduced
/// units, it is F_0/a for disks and F_0/a^2 for spheres. Without cohesion there is no pull-off force F_0, and the text
/// is "units of the state".
/// @param units  "reduced" or "SI"
std::string stress_unit(const std::string& units, int dimension, bool cohesive);

/// Moduli of a state and bounds of these moduli (stress). A bound that does not hold is NaN.
struct ModuliPoint {
  double P_star;
  double B, B_S, G, B_reuss, B_voigt, G_voigt;
  /// Whether the load path drives one axis of the state. P_star is then computed from the mean stress.
  bool is_driven = false;

  /// Returns this point with NaN in place of the bounds that do not hold.
  /// @param hold  whether the bounds of the bulk modulus, B_reuss <= B <= B_voigt, and of the shear modulus, G <=
  /// G_voigt, are valid
  /// @param stable  whether no eigenvalue of the stiffness matrix is negative; if true, G <= G_voigt is valid even if
  /// `hold` is false
  ModuliPoint with_bounds(bool hold, bool stable) const;
};

/// Converts the computed moduli of a state to a point of the plot, with NaN for bounds that do not hold.
ModuliPoint moduli_point(double P_star, const Moduli& moduli);

/// Plots moduli and their bounds against P*, on logarithmic axes. Filled symbols are for loading and open symbols for
/// unloading.
/// @param unit  unit of the moduli, for the label of the axis
Plot moduli_plot(const std::vector<ModuliPoint>& points, const std::string& unit);

}  // namespace floc
