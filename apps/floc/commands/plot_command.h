#pragma once

#include <string>
#include <vector>

#include "plots/gnuplot.h"

namespace floc {

/// One curve of a plot command.
struct Curve {
  int block;              ///< index of the block that it draws
  std::string how;        ///< "using 1:2 with lines title 'law'"
  std::string loop = {};  ///< loop over curves, such as "for [k=1:4]"; may be empty
};

/// Returns the gnuplot command that plots the curves. Curves whose blocks have no finite values are left out, so that
/// they have no entry in the legend.
std::string plot_command(const Plot& plot, const std::vector<Curve>& curves);

}  // namespace floc
