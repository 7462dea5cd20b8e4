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

/// Returns "normal", "tangential" or "rolling".
std::string name_of(ForceKind kind);

/// Unit in which forces are measured.
enum class ForceUnit {
  pull_off,  ///< F0, moments F0 a with a the largest diameter
  mean,      ///< the mean size of the forces of their own kind
  pressure,  ///< P a^(Dim-1), moments times a
};

/// Returns the forces of one kind, one entry per contact between grains in the order of the list (force, or
/// force * length).
template <int Dim>
std::vector<double> contact_forces(const Packing<Dim>& packing, ForceKind kind);

/// Largest number of bins on either side of zero.
inline constexpr int kMaxBins = 100000;

/// Histogram of contact forces f, or of any values, in a unit: bin b counts [b, b + 1) * width for b from `first`.
struct ForceDistribution {
  double unit = 0.0;   ///< unit of f (force, or force * length); 0 where there is no such force
  double width = 0.0;  ///< width of a bin, in units
  int first = 0;  ///< number of the first bin; bins begin at multiples of the width, so signs are never mixed
  std::vector<std::int64_t> counts;
  std::int64_t n = 0;          ///< number of forces, including those outside
  std::int64_t n_outside = 0;  ///< number of forces more than kMaxBins widths from zero, which are in no bin

  double low(int b) const { return (first + b) * width; }
  double middle(int b) const { return (first + b + 0.5) * width; }
  /// Probability density of f/unit; its integral is the share of the forces that are in bins.
  double density(int b) const { return static_cast<double>(counts[b]) / (static_cast<double>(n) * width); }
  /// Adds the counts of another state, bin by bin. @pre the same width, or one of the two is empty
  void add(const ForceDistribution& other);
};

/// Returns the distribution of any values in a given unit, with bins from the smallest value to the largest,
/// none beyond kMaxBins. It is empty without values, or if the unit is zero.
/// @param unit   of either sign; a negative unit reverses the sign of the values
/// @param width  width of the bins, in units, > 0; otherwise InputError
ForceDistribution distribution_of(const std::vector<double>& values, double unit, double width);

/// Returns a sentence for the user about values that are in no bin.
/// @param what    name of the values, in the plural   @param remedy  option that has to be larger
std::string outside_bins(const ForceDistribution& d, const std::string& what, const std::string& remedy);

/// Returns the magnitudes of the values of one sign; zero has neither sign. @param sign  1 or -1
std::vector<double> sizes_of(const std::vector<double>& values, double sign);

/// Returns the mean of |x|, 0 without values.
double mean_size(const std::vector<double>& values);

/// Returns P a^(Dim-1), with P the mean of the normal stresses (force). It may be of either sign.
template <int Dim>
double pressure_force(const Packing<Dim>& packing);

/// Returns whether the pressure is zero up to rounding and the tolerance of equilibrium: no larger than one
/// part in 10^8 of the pressure that the forces would have if all were compressive.
template <int Dim>
bool pressure_is_noise(const Packing<Dim>& packing);

/// Returns the unit of the forces of one kind (force, or force * length). It is 0 where there is none: without
/// adhesion, without positive pressure, or without such forces beyond rounding.
template <int Dim>
double force_unit(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit);

/// Returns the distribution of the forces of one kind in force_unit(). @param width  of the bins, in units, > 0
template <int Dim>
ForceDistribution force_distribution(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit, double width);

}  // namespace floc
