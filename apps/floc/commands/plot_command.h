#pragma once

#include <string>
#include <vector>

#include "plots/gnuplot.h"

namespace floc {

/// One curve of a plot command: how a block is drawn, and how a loop over curves begins ("for [k=1:4]").
struct Curve {
  int block;
  std::string how;  ///< "using 1:2 with lines title 'law'"
  std::string loop = {};
};

/// The command that plots the curves whose blocks have a number to draw, and so no legend of what is not drawn.
std::string plot_command(const Plot& plot, const std::vector<Curve>& curves);

}  // namespace floc
