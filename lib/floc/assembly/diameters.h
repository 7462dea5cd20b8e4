#pragma once

#include <vector>

namespace floc {

/// Distribution of grain diameters (length), by number.
struct DiameterDistribution {
  enum class Kind {
    uniform,     ///< density P(d) constant from min to max
    constant,    ///< all grains have one diameter
    bidisperse,  ///< grains have one of two diameters
    list,        ///< the diameter of each grain is given
    power_law,   ///< density P(d) ~ d^-exponent from min to max
    lognormal,   ///< ln d is normally distributed about ln median; the distribution is cut off at min and max
  };
  Kind kind = Kind::uniform;
  double min = 0.0;             ///< smallest diameter; the smaller one if bidisperse, the only one if constant
  double max = 0.0;             ///< largest diameter; the larger one if bidisperse
  double share_of_large = 0.5;  ///< fraction of the number of grains that have the larger diameter (bidisperse)
  std::vector<double> values;   ///< diameter of each grain (list)
  double exponent = 0.0;        ///< exponent of the power law (power_law)
  double median = 0.0;          ///< median of the diameters before the distribution is cut off (lognormal)
  double sigma = 0.0;           ///< standard deviation of ln d before the distribution is cut off (lognormal)
};

/// Exponent 3 of a power law, P(d) ~ d^-3: spheres of each size between min and max fill equal volumes.
inline constexpr double kUniformByVolume = 3.0;
/// Exponent 2 of a power law, P(d) ~ d^-2: disks of each size between min and max fill equal areas.
inline constexpr double kUniformByArea = 2.0;

/// Returns a quantile of a power law or a lognormal distribution: the diameter below which a given fraction of
/// the grains lies (length). The ends are exact: the fraction 0 gives min and the fraction 1 gives max.
/// @param share  the fraction, 0 to 1
double diameter_quantile(const DiameterDistribution& distribution, double share);

/// Returns n diameters in ascending order (length): equally spaced quantiles of the distribution, from min to
/// max. The sample then has the moments of the distribution, and its largest grain is exactly the unit of
/// length of dimensionless pressures and stiffnesses. A list of diameters is returned unchanged.
std::vector<double> equally_spaced_diameters(const DiameterDistribution& distribution, int n);

/// Returns the fraction of a lognormal distribution that lies between min and max, before it is cut off there.
double share_within_bounds(const DiameterDistribution& lognormal);

}  // namespace floc
