#pragma once

#include <string>
#include <vector>

#include "plots/gnuplot.h"

namespace floc {

/// One curve of a gnuplot `plot` command.
struct Curve {
  int block;              ///< index of the data block with the points of the curve
  std::string how;        ///< columns and line style, such as "using 1:2 with lines title 'law'"
  std::string loop = {};  ///< gnuplot loop that repeats the curve, such as "for [k=1:4]"; may be empty
};

/// Returns the gnuplot command that draws the curves. A curve whose data block contains no finite values is left out,
/// so that the legend does not list it.
std::string plot_command(const Plot& plot, const std::vector<Curve>& curves);

}  // namespace floc
