#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "floc/assembly/sieve_curve.h"

namespace floc {

/// Distribution of the diameters of grains (length). It gives the number of grains of each diameter, not their volume;
/// only sieve curves give masses.
struct DiameterDistribution {
  enum class Kind {
    uniform,     ///< probability density P(d) of the diameter d is constant from min to max
    constant,    ///< all grains have one diameter
    bidisperse,  ///< grains have one of two diameters
    list,        ///< the diameter of each grain is given
    power_law,   ///< probability density P(d) ~ d^-exponent from min to max
    /// ln d is normally distributed about ln median; diameters below min and above max are cut off
    lognormal,
    sieve,  ///< fractions of the mass of the grains that are finer than given sizes (SieveCurve)
  };
  /// Fractions of the number of grains at which the quantiles are taken as the diameters of N grains i = 0 ... N - 1.
  enum class Quantiles {
    ends,    ///< i/(N - 1): there is one grain of the smallest and one of the largest diameter
    middle,  ///< (i + 1/2)/N: each grain stands for an equal share of the number of grains
  };
  Kind kind = Kind::uniform;
  Quantiles quantiles = Quantiles::ends;
  double min = 0.0;  ///< smallest diameter; the smaller of two if bidisperse, the only diameter if constant
  double max = 0.0;  ///< largest diameter: the larger of two if bidisperse
  /// number of grains with the larger diameter divided by the number of all grains (bidisperse)
  double share_of_large = 0.5;
  std::vector<double> values;  ///< diameter of each grain (list)
  double exponent = 0.0;       ///< exponent of the power law (power_law)
  double median = 0.0;  ///< median diameter before the distribution is cut off at min and max (lognormal)
  /// standard deviation of ln d before the distribution is cut off at min and max (lognormal)
  double sigma = 0.0;
  SieveCurve curve;   ///< mass fractions below sizes from min to max (sieve)
  int dimension = 3;  ///< dimension of the grains, 2 or 3, by which numbers follow from masses (sieve)
};

/// Exponent of the power law P(d) ~ d^-3 for the number of spheres of diameter d. Equal intervals of diameter between
/// min and max then contain equal volumes of spheres.
inline constexpr double kUniformByVolume = 3.0;
/// Exponent of the power law P(d) ~ d^-2 for the number of disks of diameter d. Equal intervals of diameter between min
/// and max then contain equal areas of disks.
inline constexpr double kUniformByArea = 2.0;

/// Returns a quantile of a uniform, power-law, lognormal or sieve distribution of diameters: the diameter below which a
/// given fraction of the number of grains lies (length). For the fraction 0 it is exactly min, for the fraction 1
/// exactly max.
/// @param share  fraction of the number of grains, 0 to 1
double diameter_quantile(const DiameterDistribution& distribution, double share);

/// Returns n diameters that represent a distribution without random scatter (length): its quantiles at equally spaced
/// fractions of the grains, see DiameterDistribution::Quantiles. With the ends included, the largest diameter is
/// exactly max. A list of diameters is returned unchanged.
std::vector<double> equally_spaced_diameters(const DiameterDistribution& distribution, int n);

/// Returns the smallest and the largest of equally_spaced_diameters() (length); min and max if n < 1.
std::pair<double, double> smallest_and_largest(const DiameterDistribution& distribution, int n);

/// Returns the fraction of a complete lognormal distribution that lies between its cut-offs min and max.
double share_within_bounds(const DiameterDistribution& lognormal);

/// Returns the fraction of the volume (area in 2D) of all grains that a continuous distribution assigns to the grains
/// below a diameter. The result is std::nullopt for distributions of single diameters (constant, bidisperse, list), and
/// for lognormal distributions that are too wide for the computation.
/// @param dimension  2 for disks, 3 for spheres
std::optional<double> volume_share_below(const DiameterDistribution& distribution, int dimension,
                                         double diameter);

}  // namespace floc
