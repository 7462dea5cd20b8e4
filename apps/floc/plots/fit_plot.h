#pragma once

#include <string>
#include <vector>

#include "floc/fitting/consolidation.h"
#include "plots/gnuplot.h"

namespace floc {

/// Contents of a plot of a fit.
struct ConsolidationPlot {
  std::string title;
  std::string unit;    ///< of the pressures; empty in reduced units
  std::string stress;  ///< stress that is the pressure of oedometric rows: see PathTable::stress
  const ConsolidationCurve& curve;
  const ConsolidationFit& fit;
};

/// Returns the label of the axis of pressures.
/// @param unit    of the pressures; empty in reduced units
/// @param stress  stress that is the pressure of oedometric rows: see PathTable::stress
std::string pressure_label(const std::string& unit, const std::string& stress);

/// Plots 1/Phi against P* with the fitted curve and its window, and the residuals below.
Plot plot_of_fit(const ConsolidationPlot& of);

/// Returns the standard error of the mean of 1/Phi over samples at the i-th pressure; 0 for a single curve.
double error_of_mean(const ConsolidationCurve& curve, std::size_t i);

/// Returns points of the fitted curve over its window: rows of P* and 1/Phi. @pre fit.found()
std::vector<std::vector<double>> law_points(const ConsolidationFit& fit);

}  // namespace floc
