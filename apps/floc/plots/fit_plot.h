#pragma once

#include <string>
#include <vector>

#include "floc/fitting/consolidation.h"
#include "plots/gnuplot.h"

namespace floc {

/// Contents of the plot that shows how the consolidation law fits a curve.
struct ConsolidationPlot {
  std::string title;
  std::string unit;  ///< unit of the pressures; empty in reduced units
  /// Stress that is taken as the pressure of an oedometer test: "driven" or "mean"; empty for other tests.
  std::string stress;
  const ConsolidationCurve& curve;
  const ConsolidationFit& fit;
  /// Pairs of P* and 1/Phi of the unloading and reloading branches, which are not fitted. Each branch ends with a row
  /// of NaN.
  std::vector<std::vector<double>> loops = {};
};

/// Returns the label of the pressure axis.
/// @param unit  unit of the pressures; empty in reduced units
/// @param stress  stress that is taken as the pressure of an oedometer test: "driven" or "mean"; empty for other tests
std::string pressure_label(const std::string& unit, const std::string& stress);

/// Plots 1/Phi (Phi: solid fraction) against the pressure P*. The plot shows the fitted law and the range of pressures
/// to which it was fitted, the recompression line at smaller pressures, and the yield pressure at which this line meets
/// the law. A second panel below shows the residuals.
Plot plot_of_fit(const ConsolidationPlot& of);

/// Returns the standard error of the mean of 1/Phi over all samples at the i-th pressure; 0 for a single sample.
double error_of_mean(const ConsolidationCurve& curve, std::size_t i);

/// Returns points of the fitted law, as pairs of P* and 1/Phi, in the range of pressures to which it was fitted. @pre
/// fit.found()
std::vector<std::vector<double>> law_points(const ConsolidationFit& fit);

}  // namespace floc
