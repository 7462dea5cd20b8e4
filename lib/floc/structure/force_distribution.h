#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

enum class ForceKind {
  normal,      ///< static normal force with its sign, of every interaction, including attraction across a gap
  tangential,  ///< magnitude of the tangential force of contacts that touch
  rolling,     ///< magnitude of the rolling moment of contacts that touch
};

/// Returns "normal", "tangential" or "rolling".
std::string name_of(ForceKind kind);

/// Unit in which contact forces and moments are measured.
enum class ForceUnit {
  pull_off,  ///< pull-off force F0 for forces, F0 a for moments (a is the largest diameter)
  mean,      ///< mean magnitude of the forces of that kind
  pressure,  ///< P a^(Dim-1) for forces, P a^Dim for moments (P is the pressure, a the largest diameter)
};

/// Returns the forces of one kind, one per contact between grains, in the order of the contact list (force, or
/// force * length).
template <int Dim>
std::vector<double> contact_forces(const Packing<Dim>& packing, ForceKind kind);

/// Largest number of bins of a histogram on either side of zero.
inline constexpr int kMaxBins = 100000;

/// Histogram of contact forces f, or of any values, measured in `unit`. Bin number b counts the values in [b, b
/// + 1) * width; the numbers begin with `first`.
struct ForceDistribution {
  double unit = 0.0;   ///< unit of f (force, or force * length); 0 if there is no such unit
  double width = 0.0;  ///< width of a bin, in `unit`
  int first = 0;  ///< number of the first bin; bins begin at multiples of the width, so that no bin mixes signs
  std::vector<std::int64_t> counts;
  std::int64_t n = 0;          ///< number of values, including those in no bin
  std::int64_t n_outside = 0;  ///< number of values more than kMaxBins widths from zero, which are in no bin

  double low(int b) const { return (first + b) * width; }
  double middle(int b) const { return (first + b + 0.5) * width; }
  /// Returns the probability density of f/unit in a bin; its integral is the share of the values that are in
  /// bins.
  double density(int b) const { return static_cast<double>(counts[b]) / (static_cast<double>(n) * width); }
  /// Adds the counts of another histogram, bin by bin. @pre Both have one width, or one of them is empty.
  void add(const ForceDistribution& other);
};

/// Returns the histogram of any values in a given unit, with bins from the smallest value to the largest, but
/// at most kMaxBins on either side of zero. The histogram is empty if there are no values or if the unit is
/// zero.
/// @param unit   unit of the values; a negative unit reverses their signs
/// @param width  width of the bins, in `unit`, > 0; otherwise InputError
ForceDistribution distribution_of(const std::vector<double>& values, double unit, double width);

/// Returns a warning about values that are in no bin of their histogram.
/// @param what  name of the values, in the plural   @param remedy  option that has to be larger
std::string outside_bins(const ForceDistribution& d, const std::string& what, const std::string& remedy);

/// Returns the magnitudes of the values of one sign, without zeros. @param sign  1 or -1
std::vector<double> sizes_of(const std::vector<double>& values, double sign);

/// Returns the mean magnitude of values; 0 if there are none.
double mean_size(const std::vector<double>& values);

/// Returns the force P a^(Dim-1), with P the mean normal stress, which may have either sign, and a the largest
/// diameter.
template <int Dim>
double pressure_force(const Packing<Dim>& packing);

/// Returns whether the pressure is zero up to rounding and the tolerance of equilibrium: at most 1e-8 of the
/// pressure that the contact forces would cause if all were compressive.
template <int Dim>
bool pressure_is_noise(const Packing<Dim>& packing);

/// Returns the unit of the forces of one kind (force, or force * length). The unit is 0 if it does not exist:
/// without adhesion (pull_off), without positive pressure (pressure), or without forces of that kind beyond
/// rounding (mean).
template <int Dim>
double force_unit(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit);

/// Returns the histogram of the forces of one kind in the unit of force_unit(). @param width  width of the bins,
/// in that unit, > 0
template <int Dim>
ForceDistribution force_distribution(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit, double width);

}  // namespace floc
