#pragma once

#include <string>

#include "floc/tradeoff/tradeoff.h"

namespace floc {

/// Plots the errors of two observables of a state against the processor time per sample, with one curve per
/// parameter of the scene. The observables are the solid fraction Phi and the bulk modulus B; for rigid grains
/// Phi and the coordination number z; for cemented grains Young's modulus and the tail of the stress
/// distribution in grains. Writes the picture F.svg, its data F.dat and its gnuplot script F.gp.
/// @throws InputError if the name does not end in .svg; IoError if a file cannot be written, or if gnuplot is
/// missing or fails
void plot_tradeoff(const std::string& file, const Tradeoff& tradeoff);

}  // namespace floc
