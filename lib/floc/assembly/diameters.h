#pragma once

#include <vector>

namespace floc {

/// Distribution of grain diameters (length), by number.
struct DiameterDistribution {
  enum class Kind {
    uniform,     ///< P(d) constant from min to max
    constant,    ///< all of one size
    bidisperse,  ///< two sizes
    list,        ///< one diameter per grain
    power_law,   ///< P(d) ~ d^-exponent from min to max
    lognormal,   ///< ln d normal about ln median, cut off at min and max
  };
  Kind kind = Kind::uniform;
  double min = 0.0;             ///< the small size of bidisperse; the size of constant
  double max = 0.0;             ///< the large size of bidisperse
  double share_of_large = 0.5;  ///< bidisperse: number share of large grains
  std::vector<double> values;   ///< list: one diameter per grain
  double exponent = 0.0;        ///< power_law
  double median = 0.0;          ///< lognormal, of the distribution before it is cut off
  double sigma = 0.0;           ///< lognormal: standard deviation of ln d, before it is cut off
};

/// Exponent 3, P(d) ~ d^-3: spheres of each size between min and max fill equal volumes.
inline constexpr double kUniformByVolume = 3.0;
/// Exponent 2, P(d) ~ d^-2: disks of each size fill equal areas.
inline constexpr double kUniformByArea = 2.0;

/// Quantile of a power law or a lognormal distribution: diameter below which a share of the grains lies
/// (length). The ends are exact: share 0 gives min and share 1 gives max.
/// @param share  0 to 1
double diameter_quantile(const DiameterDistribution& distribution, double share);

/// Returns n diameters in ascending order (length): equally spaced quantiles, from min to max, so that the
/// sample has the moments of the distribution and its largest grain is exactly the unit of length of P* and
/// kappa. A list is returned unchanged.
std::vector<double> equally_spaced_diameters(const DiameterDistribution& distribution, int n);

/// Share of the lognormal distribution that lies between min and max, before it is cut off there.
double share_within_bounds(const DiameterDistribution& lognormal);

}  // namespace floc
