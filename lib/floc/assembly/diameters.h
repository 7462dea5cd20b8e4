#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "floc/assembly/sieve_curve.h"

namespace floc {

/// Distribution of the diameters of grains (length). Sieve curves give the mass of the grains of each diameter; all
/// other kinds give the number of these grains.
struct DiameterDistribution {
  enum class Kind {
    uniform,     ///< probability density P(d) of the diameter d is constant from min to max
    constant,    ///< all grains have one diameter
    bidisperse,  ///< grains have one of two diameters
    list,        ///< the diameter of each grain is given
    power_law,   ///< probability density P(d) ~ d^-exponent from min to max
    /// ln d is normally distributed with the mean ln median; diameters below min and above max do not occur
    lognormal,
    sieve,  ///< the mass fraction of the grains finer than d is given for some diameters d (SieveCurve)
  };
  /// Choice of the diameters of N grains with the numbers i = 0 ... N - 1. The diameter of grain i is a quantile of the
  /// distribution; each enumerator gives the fraction of this quantile.
  enum class Quantiles {
    ends,    ///< i/(N - 1): there is one grain of the smallest and one of the largest diameter
    middle,  ///< (i + 1/2)/N: the middles of N equal parts of the distribution
  };
  Kind kind = Kind::uniform;
  Quantiles quantiles = Quantiles::ends;
  double min = 0.0;  ///< smallest diameter; the only diameter if constant
  double max = 0.0;  ///< largest diameter
  /// number of grains with the larger diameter divided by the number of all grains (bidisperse)
  double share_of_large = 0.5;
  std::vector<double> values;  ///< diameter of each grain (list)
  double exponent = 0.0;       ///< exponent of the power law (power_law)
  double median = 0.0;  ///< median diameter before the distribution is cut off at min and max (lognormal)
  /// standard deviation of ln d before the distribution is cut off at min and max (lognormal)
  double sigma = 0.0;
  /// mass fraction of the grains below each size; the sizes range from min to max (sieve)
  SieveCurve curve;
  int dimension = 3;  ///< dimension of the grains, 2 or 3, to convert masses to numbers of grains (sieve)
};

/// Exponent of the power law P(d) ~ d^-3 for the number of spheres of diameter d. Equal intervals of diameter between
/// min and max then contain equal volumes of spheres.
inline constexpr double kUniformByVolume = 3.0;
/// Exponent of the power law P(d) ~ d^-2 for the number of disks of diameter d. Equal intervals of diameter between min
/// and max then contain equal areas of disks.
inline constexpr double kUniformByArea = 2.0;

/// Returns a quantile of a uniform, power-law, lognormal or sieve distribution of diameters: the diameter below which a
/// given fraction of the number of grains lies (length). The result is exactly min for the fraction 0, and exactly max
/// for the fraction 1.
/// @param share  fraction of the number of grains, 0 to 1
double diameter_quantile(const DiameterDistribution& distribution, double share);

/// Returns n diameters that represent a distribution without random scatter (length): the quantiles of the distribution
/// at equally spaced fractions (DiameterDistribution::Quantiles). With Quantiles::ends, the largest diameter is exactly
/// max. A list of diameters is returned unchanged.
std::vector<double> equally_spaced_diameters(const DiameterDistribution& distribution, int n);

/// Returns the smallest and the largest of equally_spaced_diameters() (length); min and max if n < 1.
std::pair<double, double> smallest_and_largest(const DiameterDistribution& distribution, int n);

/// Returns the fraction of the grains with diameters between min and max, for a lognormal distribution that is not cut
/// off at min and max.
double share_within_bounds(const DiameterDistribution& lognormal);

/// Returns the volume (area in 2D) of the grains below a diameter, divided by the volume of all grains. The result is
/// std::nullopt for distributions that are not continuous (constant, bidisperse, list), and for lognormal distributions
/// that are too wide for the computation.
/// @param dimension  2 for disks, 3 for spheres
std::optional<double> volume_share_below(const DiameterDistribution& distribution, int dimension,
                                         double diameter);

}  // namespace floc
