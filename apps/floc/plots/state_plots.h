#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/structure/force_distribution.h"
#include "plots/gnuplot.h"

namespace floc {

/// Forces of one state on their way into a plot.
struct ForceSample {
  std::string name;  ///< in the legend
  ForceDistribution distribution;
  std::vector<double> forces;  ///< the same, one by one, in the unit of the distribution
};

/// The forces of a packing, binned so finely that about twenty bins hold nine tenths of them.
/// @throws InputError naming the place where the unit vanishes
template <int Dim>
ForceSample force_sample(const std::string& place, const std::string& name, const Packing<Dim>& packing,
                         ForceKind kind, ForceUnit unit);

/// Probability densities of contact forces on a logarithmic axis, errors by their counts, with exponential
/// tails of both signs fitted beyond the mean of each.
Plot forces_plot(const std::vector<ForceSample>& samples, ForceKind kind, ForceUnit unit);

/// Particle pressures of one state, over F0/<d>^(d-1) or, without adhesion, over the pressure.
struct PressureSample {
  std::string name;               ///< in the legend
  std::vector<double> pressures;  ///< of the grains that are no rattlers
  bool over_adhesion = true;      ///< what they are over
};

/// @param zero_force  largest normal force that counts as zero (force)
/// @throws InputError naming the place where there is nothing to measure pressures in
template <int Dim>
PressureSample pressure_sample(const std::string& place, const std::string& name, const Packing<Dim>& packing,
                               double zero_force);

/// Probability densities of particle pressures on a logarithmic axis, errors by their counts, with an exponential
/// of each sign by maximum likelihood.
/// @pre all samples are over the same, at least one
Plot pressures_plot(const std::vector<PressureSample>& samples);

/// A state whose scattering is plotted.
struct ScatteringSample {
  std::string name;
  int dimension = 2;
  std::vector<double> k, I, error;   ///< in 2 pi/a and a^dimension, a the largest diameter
  std::vector<double> fit_k, fit_I;  ///< the law where it was fitted; empty without a fit
  std::string parameters;            ///< of the law, in words
  std::string failure_reason;        ///< why there is no fit
};

/// I(k), the grains' indicator scattered, and the law fitted for k up to half of 2 pi/a.
template <int Dim>
ScatteringSample scattering_sample(const std::string& name, const Packing<Dim>& packing);

/// @pre all samples are of one dimension
Plot scattering_plot(const std::vector<ScatteringSample>& samples);

}  // namespace floc
