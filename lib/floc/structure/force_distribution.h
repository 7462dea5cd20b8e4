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

/// Bins reach as far as this many widths on either side of zero.
inline constexpr int kMaxBins = 100000;

/// Histogram of contact forces f, or of any values, in a unit: bin b counts [b, b + 1) * width for b from `first`.
struct ForceDistribution {
  double unit = 0.0;   ///< what f is measured in (force, or force * length); 0 where there is no such force
  double width = 0.0;  ///< of a bin, in units
  int first = 0;  ///< number of the first bin; bins begin at multiples of the width, so signs are never mixed
  std::vector<std::int64_t> counts;
  std::int64_t n = 0;          ///< forces, those outside included
  std::int64_t n_outside = 0;  ///< of them, more than kMaxBins widths from zero: in no bin

  double low(int b) const { return (first + b) * width; }
  double middle(int b) const { return (first + b + 0.5) * width; }
  /// Probability density of f/unit; its integral is the share of the forces that are in bins.
  double density(int b) const { return static_cast<double>(counts[b]) / (static_cast<double>(n) * width); }
  /// Adds the counts of another state, bin by bin. @pre the same width, or one of the two is empty
  void add(const ForceDistribution& other);
};

/// The distribution of any values in a given unit: bins from the one of the smallest to that of the largest, none
/// beyond kMaxBins. Empty without values, or where the unit is zero.
/// @param unit   of either sign, which then is that of positive numbers   @param width  of the bins, in units, > 0;
/// otherwise InputError
ForceDistribution distribution_of(const std::vector<double>& values, double unit, double width);

/// Tells of values that are in no bin. @param remedy  what to choose otherwise
std::string outside_bins(const ForceDistribution& d, const std::string& what, const std::string& remedy);

/// Magnitudes of the values of one sign; zero belongs to neither. @param sign  1 or -1
std::vector<double> sizes_of(const std::vector<double>& values, double sign);

/// Mean of |x|, 0 without values.
double mean_size(const std::vector<double>& values);

/// P a^(Dim-1), with the mean of the normal stresses for P (force); it may be of either sign.
template <int Dim>
double pressure_force(const Packing<Dim>& packing);

/// Whether the pressure, if there is any, is what rounding and the equilibrium leave of zero: as large as one part in
/// 10^8 of what the forces would add up to if they all pushed.
template <int Dim>
bool pressure_is_noise(const Packing<Dim>& packing);

/// A unit of the forces of one kind (force, or force * length); 0 where there is none: no adhesion, no positive
/// pressure, no such forces, or what rounding leaves in their place.
template <int Dim>
double force_unit(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit);

/// The forces of one kind in force_unit(). @param width  of the bins, in units, > 0
template <int Dim>
ForceDistribution force_distribution(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit, double width);

}  // namespace floc
