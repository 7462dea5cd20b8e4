#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

enum class ForceKind {
  normal,      ///< signed static normal force of every interaction, including attraction across a gap
  tangential,  ///< magnitude of the tangential force of contacts that touch
  rolling,     ///< magnitude of the rolling moment of contacts that touch
};

/// Returns "normal", "tangential" or "rolling".
std::string name_of(ForceKind kind);

/// Unit in which contact forces and moments are expressed.
enum class ForceUnit {
  pull_off,  ///< pull-off force F0 for forces, F0 a for moments (a is the largest diameter)
  mean,      ///< mean magnitude of all forces of one kind, see ForceKind
  pressure,  ///< P a^(Dim-1) for forces, P a^Dim for moments (P is the pressure, a the largest diameter)
};

/// Returns the forces of one kind, one per contact between grains, in the order of the contact list (force, or
/// force * length).
template <int Dim>
std::vector<double> contact_forces(const Packing<Dim>& packing, ForceKind kind);

/// Largest number of bins of a histogram on either side of zero.
inline constexpr int kMaxBins = 100000;

/// Histogram of values f, for example contact forces, divided by `unit`. Bin b = 0, 1, ... counts the values f with
/// f/unit in [first + b, first + b + 1) * width.
struct ForceDistribution {
  /// Unit of f (force, or force * length); 0 if the unit does not exist, for example the pull-off force without
  /// adhesion.
  double unit = 0.0;
  double width = 0.0;  ///< width of a bin, in `unit`
  /// Lower edge of the first bin divided by `width`. This is a whole number, so that no bin contains values of both
  /// signs.
  int first = 0;
  std::vector<std::int64_t> counts;
  std::int64_t n = 0;          ///< number of all values, in a bin or not
  std::int64_t n_outside = 0;  ///< number of values in no bin: more than kMaxBins widths from zero

  double low(int b) const { return (first + b) * width; }
  double middle(int b) const { return (first + b + 0.5) * width; }
  /// Returns the probability density of f/unit in bin b. The integral of the density over all bins is 1 minus the share
  /// of values in no bin.
  double density(int b) const { return static_cast<double>(counts[b]) / (static_cast<double>(n) * width); }
  /// Adds the counts of another histogram, bin by bin.
  /// @pre Both histograms have the same bin width, or one of them is empty.
  void add(const ForceDistribution& other);
};

/// Returns the histogram of values in a given unit. The bins extend from the smallest to the largest value, with at
/// most kMaxBins bins on either side of zero. The histogram is empty if there are no values, or if the unit is zero.
/// @param unit   unit of the values; a negative unit reverses their signs
/// @param width  width of the bins, in `unit`, > 0; otherwise InputError
ForceDistribution distribution_of(const std::vector<double>& values, double unit, double width);

/// Returns a warning about values that are in no bin of their histogram.
/// @param what    name of the values, in the plural
/// @param remedy  option that the user has to increase
std::string outside_bins(const ForceDistribution& d, const std::string& what, const std::string& remedy);

/// Returns the magnitudes of all values with the given sign; zeros are left out.
/// @param sign  1 or -1
std::vector<double> sizes_of(const std::vector<double>& values, double sign);

/// Returns the mean magnitude of the values; 0 if there are no values.
double mean_size(const std::vector<double>& values);

/// Returns the force P a^(Dim-1). P is the mean normal stress of the packing, which may be negative, and a is the
/// largest diameter.
template <int Dim>
double pressure_force(const Packing<Dim>& packing);

/// Returns whether the pressure is zero up to rounding and the tolerance of equilibrium. The limit is 1e-8 of the
/// pressure that would result if all contact forces were compressive.
template <int Dim>
bool pressure_is_noise(const Packing<Dim>& packing);

/// Returns the unit of the forces of one kind (force, or force * length). The result is 0 if the unit does not exist:
/// the unit `pull_off` without adhesion, `pressure` if the pressure is not positive, and `mean` if all forces of this
/// kind are zero up to rounding.
template <int Dim>
double force_unit(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit);

/// Returns the histogram of the forces of one kind, divided by force_unit().
/// @param width  width of the bins, in this unit, > 0
template <int Dim>
ForceDistribution force_distribution(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit, double width);

}  // namespace floc
