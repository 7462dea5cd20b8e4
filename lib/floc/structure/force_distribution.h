#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

enum class ForceKind {
  normal,      ///< static normal force, sign kept; every interaction, distant attractions included
  tangential,  ///< size of the tangential force; contacts that touch
  rolling,     ///< size of the rolling moment; contacts that touch
};

/// "normal", "tangential", "rolling"
std::string name_of(ForceKind kind);

/// What forces are measured in.
enum class ForceUnit {
  pull_off,  ///< F0, moments F0 a with a the largest diameter
  mean,      ///< the mean size of the forces of their own kind
  pressure,  ///< P a^(Dim-1), moments times a
};

/// The forces of one kind, one entry per contact between grains in the order of the list (force, or force * length).
template <int Dim>
std::vector<double> contact_forces(const Packing<Dim>& packing, ForceKind kind);

/// Histogram of contact forces f in a unit: bin b counts [b, b + 1) * width for b from `first`.
struct ForceDistribution {
  double unit = 0.0;   ///< what f is measured in (force, or force * length); 0 where there is no such force
  double width = 0.0;  ///< of a bin, in units
  int first = 0;  ///< number of the first bin; bins begin at multiples of the width, so signs are never mixed
  std::vector<std::int64_t> counts;
  std::int64_t n = 0;  ///< forces counted

  double low(int b) const { return (first + b) * width; }
  double middle(int b) const { return (first + b + 0.5) * width; }
  /// Probability density of f/unit.
  double density(int b) const { return static_cast<double>(counts[b]) / (static_cast<double>(n) * width); }
  /// Adds the counts of another state, bin by bin. @pre the same width, or one of the two is empty
  void add(const ForceDistribution& other);
};

/// The distribution of any values in a given unit. Empty without values, or where the unit is not positive.
/// @param width  of the bins, in units, > 0; otherwise InputError
/// Bins stop at +-1e5 widths; what lies beyond is in the last ones.
ForceDistribution distribution_of(const std::vector<double>& values, double unit, double width);

/// Magnitudes of the values of one sign; zero belongs to neither. @param sign  1 or -1
std::vector<double> sizes_of(const std::vector<double>& values, double sign);

/// Mean of |x|, 0 without values.
double mean_size(const std::vector<double>& values);

/// P a^(Dim-1), with the mean of the normal stresses for P (force); it may be of either sign.
template <int Dim>
double pressure_force(const Packing<Dim>& packing);

/// @param width  of the bins, in units, > 0
/// Empty where the unit vanishes: no adhesion, no pressure, or no such forces.
template <int Dim>
ForceDistribution force_distribution(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit, double width);

}  // namespace floc
