#pragma once

#include <string>

#include "floc/tradeoff/tradeoff.h"

namespace floc {

/// Draws error against cost for Phi and B, one curve per parameter: F.svg, with F.dat and F.gp beside it.
/// @throws InputError if the name does not end in .svg; IoError if a file cannot be written or gnuplot fails or
/// is missing
void plot_tradeoff(const std::string& file, const Tradeoff& tradeoff);

}  // namespace floc
