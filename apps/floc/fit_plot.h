#pragma once

#include <string>

#include "floc/fitting/consolidation.h"

namespace floc {

/// What a plot of a fit shows.
struct ConsolidationPlot {
  std::string title;
  std::string unit;  ///< of the pressures; empty in reduced units
  const ConsolidationCurve& curve;
  const ConsolidationFit& fit;
};

/// Draws 1/Phi against P* with the fitted curve, window and plateau, and the residuals below, by gnuplot. Data
/// and script are kept beside the picture: F.svg, F.dat, F.gp.
/// @throws InputError if the name does not end in .svg; IoError if a file cannot be written or gnuplot fails or
/// is missing
void plot_consolidation(const std::string& file, const ConsolidationPlot& plot);

}  // namespace floc
