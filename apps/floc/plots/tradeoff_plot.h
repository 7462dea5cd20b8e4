#pragma once

#include <string>

#include "floc/tradeoff/tradeoff.h"

namespace floc {

/// Plots the errors of the solid fraction Phi and of the bulk modulus B (of the coordination number z
/// for rigid grains) of a state against the processor time per
/// sample, with one curve per parameter of the scene. Writes the picture F.svg, its data F.dat and its gnuplot script
/// F.gp.
/// @throws InputError if the name does not end in .svg; IoError if a file cannot be written, or if gnuplot is missing
/// or fails
void plot_tradeoff(const std::string& file, const Tradeoff& tradeoff);

}  // namespace floc
