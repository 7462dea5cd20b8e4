#pragma once

#include <optional>
#include <vector>

#include "floc/assembly/assembly_options.h"

namespace floc {

/// Interval of diameters, with the share of the grains of a scene in this interval, and the share that the distribution
/// of diameters gives for the interval. A share is a volume (area in 2D) divided by the volume of all grains. For
/// grains with corners, the volumes are those of the circumscribed spheres (circles).
struct SizeClass {
  /// Ends of the interval (length). The end `to` belongs to the interval; the end `from` belongs only to the first
  /// interval.
  double from = 0.0, to = 0.0;
  int n_grains = 0;
  double share = 0.0;    ///< share of the grains in the interval
  double passing = 0.0;  ///< share of the grains with diameters up to `to`
  /// exact values of `share` and `passing` for the distribution; absent for distributions of single diameters
  std::optional<double> share_asked, passing_asked;
};

/// Returns the size classes of grains: the intervals between the sieves of a sieve curve or, for other distributions,
/// the four equal parts of their range of diameters. If all grains have one size, there are no classes.
/// @param distribution  distribution from which the grains were drawn
/// @param diameters  diameters of the grains (length)
/// @param dimension  2 for disks, 3 for spheres
std::vector<SizeClass> size_classes(const DiameterDistribution& distribution,
                                    const std::vector<double>& diameters, int dimension);

/// Returns the size classes of the grains of a scene.
std::vector<SizeClass> size_classes(const GrainOptions& grains, int dimension);

/// Returns size classes of the grains of a scene: the four equal parts of their range of diameters, also for a sieve
/// curve.
std::vector<SizeClass> size_quarters(const GrainOptions& grains, int dimension);

}  // namespace floc
