#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/structure/force_distribution.h"
#include "plots/gnuplot.h"

namespace floc {

/// Forces of one state, as a plot needs them.
struct ForceSample {
  std::string name;  ///< name in the legend
  ForceDistribution distribution;
  std::vector<double> forces;  ///< forces of which it is the distribution, in its unit
};

/// Returns the forces of a packing and their distribution, with bins such that about twenty hold nine tenths of them.
/// @throws InputError naming `place` if there are no such forces or their unit vanishes
template <int Dim>
ForceSample force_sample(const std::string& place, const std::string& name, const Packing<Dim>& packing,
                         ForceKind kind, ForceUnit unit);

/// Plots probability densities of contact forces on a logarithmic axis, with errors from the counts, and exponential
/// tails fitted to the forces of each sign beyond their mean.
Plot forces_plot(const std::vector<ForceSample>& samples, ForceKind kind, ForceUnit unit);

/// Particle pressures of one state, in units of F0/<d>^(d-1) or, without adhesion, of the pressure of the state.
struct PressureSample {
  std::string name;               ///< name in the legend
  std::vector<double> pressures;  ///< pressures of the grains that are not rattlers
  bool over_adhesion = true;      ///< the unit: F0/<d>^(d-1); false: the pressure of the state
};

/// Returns the particle pressures of a packing.
/// @param zero_force  largest normal force that counts as zero (force)
/// @throws InputError naming `place` if there is no unit of pressure
template <int Dim>
PressureSample pressure_sample(const std::string& place, const std::string& name, const Packing<Dim>& packing,
                               double zero_force);

/// Plots probability densities of particle pressures on a logarithmic axis, with errors from the counts, and an
/// exponential for each sign by maximum likelihood.
/// @pre there is at least one sample, and all have the same kind of unit
Plot pressures_plot(const std::vector<PressureSample>& samples);

/// A state whose scattering is plotted.
struct ScatteringSample {
  std::string name;
  int dimension = 2;
  std::vector<double> k, I, error;   ///< k in 2 pi/a, I and its error in a^dimension; a is the largest diameter
  std::vector<double> fit_k, fit_I;  ///< points of the law over the range fitted; empty without a fit
  std::string parameters;            ///< parameters of the law, as text
  std::string failure_reason;        ///< reason why there is no fit
};

/// Computes I(k), the scattered intensity of the indicator function of the grains, and fits the law for k up to half of
/// 2 pi/a.
template <int Dim>
ScatteringSample scattering_sample(const std::string& name, const Packing<Dim>& packing);

/// Plots I(k) of the samples with their laws, both axes logarithmic. @pre all samples have the same dimension
Plot scattering_plot(const std::vector<ScatteringSample>& samples);

}  // namespace floc
