#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/structure/force_distribution.h"
#include "plots/gnuplot.h"

namespace floc {

/// Contact forces of one state, for a plot of their distribution.
struct ForceSample {
  std::string name;  ///< name in the legend
  ForceDistribution distribution;
  /// Forces or moments, in multiples of the unit that force_sample() uses; `distribution` is computed from them.
  std::vector<double> forces;
};

/// Returns the contact forces of one kind (normal, tangential, rolling) in a packing, and their distribution. The bins
/// of the distribution are chosen so that about twenty bins contain nine tenths of the forces.
/// @param place  name of the state file, for messages
/// @param name  name of the state in the legend
/// @throws InputError if the packing has no contact forces of this kind or the unit of force is zero
template <int Dim>
ForceSample force_sample(const std::string& place, const std::string& name, const Packing<Dim>& packing,
                         ForceKind kind, ForceUnit unit);

/// Plots probability densities of contact forces on a logarithmic axis, with error bars computed from the counts of the
/// bins. Exponential tails are fitted to the forces of each sign that exceed the mean force of that sign.
Plot forces_plot(const std::vector<ForceSample>& samples, ForceKind kind, ForceUnit unit);

/// Particle pressures of one state, divided by F0/<a>^(d-1), with the pull-off force F0, the mean diameter <a> and the
/// dimension d. Without adhesion, they are divided by the pressure of the state instead.
struct PressureSample {
  std::string name;               ///< name in the legend
  std::vector<double> pressures;  ///< pressures of the grains that are not rattlers
  /// Whether the pressures are divided by F0/<a>^(d-1), which needs adhesion. Otherwise they are divided by the
  /// pressure of the state.
  bool over_adhesion = true;
};

/// Returns the particle pressures of a packing.
/// @param place  name of the state file, for messages
/// @param zero_force  largest normal force that counts as zero (force)
/// @throws InputError if no grain carries forces, or if the packing has neither adhesion nor a pressure as unit
template <int Dim>
PressureSample pressure_sample(const std::string& place, const std::string& name, const Packing<Dim>& packing,
                               double zero_force);

/// Plots probability densities of particle pressures on a logarithmic axis, with error bars computed from the counts of
/// the bins. For each sign of the pressure, an exponential fitted by maximum likelihood is drawn.
/// @pre there is at least one sample, and all samples have the same kind of unit
Plot pressures_plot(const std::vector<PressureSample>& samples);

/// The scattered intensity I(k) of a state at the wave numbers k, and the law of fractal aggregates fitted to it, for a
/// plot.
struct ScatteringSample {
  std::string name;
  int dimension = 2;
  std::vector<double> k, I,
      error;  ///< k in units of 2 pi/a; I and its error in units of a^dimension (a: largest diameter)
  std::vector<double> fit_k,
      fit_I;               ///< points of the fitted law of fractal aggregates; empty if it could not be fitted
  std::string parameters;  ///< fitted parameters of the law of fractal aggregates, as text for the legend
  std::string failure_reason;  ///< reason why the law was not fitted; empty if it was fitted
};

/// Computes the scattered intensity I(k) at wave numbers k from the indicator function of the grains. Fits the law of
/// fractal aggregates to the points up to k = pi/a, where a is the largest diameter.
template <int Dim>
ScatteringSample scattering_sample(const std::string& name, const Packing<Dim>& packing);

/// Plots I(k) of the samples with the fitted laws, on logarithmic axes. @pre all samples have the same dimension
Plot scattering_plot(const std::vector<ScatteringSample>& samples);

}  // namespace floc
