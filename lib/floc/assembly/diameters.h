#pragma once

#include <vector>

namespace floc {

/// Distribution of the diameters of grains (length). It gives the number of grains of each diameter, not their volume.
struct DiameterDistribution {
  enum class Kind {
    uniform,     ///< probability density P(d) of the diameter d is constant from min to max
    constant,    ///< all grains have one diameter
    bidisperse,  ///< grains have one of two diameters
    list,        ///< the diameter of each grain is given
    power_law,   ///< probability density P(d) ~ d^-exponent from min to max
    /// ln d is normally distributed about ln median; diameters below min and above max are cut off
    lognormal,
  };
  Kind kind = Kind::uniform;
  double min = 0.0;  ///< smallest diameter: the smaller of two if bidisperse, that of all grains if constant
  double max = 0.0;  ///< largest diameter: the larger of two if bidisperse
  /// number of grains with the larger diameter over the number of all grains (bidisperse)
  double share_of_large = 0.5;
  std::vector<double> values;  ///< diameter of each grain (list)
  double exponent = 0.0;       ///< exponent of the power law (power_law)
  double median = 0.0;  ///< median diameter before the distribution is cut off at min and max (lognormal)
  /// standard deviation of ln d before the distribution is cut off at min and max (lognormal)
  double sigma = 0.0;
};

/// Exponent of the power law P(d) ~ d^-3 for the number of spheres of diameter d. Equal intervals of diameter between
/// min and max then contain equal volumes of spheres.
inline constexpr double kUniformByVolume = 3.0;
/// Exponent of the power law P(d) ~ d^-2 for the number of disks of diameter d. Equal intervals of diameter between min
/// and max then contain equal areas of disks.
inline constexpr double kUniformByArea = 2.0;

/// Returns a quantile of a power-law or lognormal distribution of diameters: the diameter below which a given fraction
/// of the grains lies (length). For the fraction 0 it is exactly min, for the fraction 1 exactly max.
/// @param share  fraction of the grains, 0 to 1
double diameter_quantile(const DiameterDistribution& distribution, double share);

/// Returns n diameters that represent a distribution without random scatter (length): its quantiles at equally spaced
/// fractions of the grains, from min to max. They have the moments of the distribution, and the largest of them is
/// exactly max, which is the unit of length of dimensionless numbers. A list of diameters is returned unchanged.
std::vector<double> equally_spaced_diameters(const DiameterDistribution& distribution, int n);

/// Returns the fraction of a complete lognormal distribution that lies between min and max, where it is cut off.
double share_within_bounds(const DiameterDistribution& lognormal);

}  // namespace floc
