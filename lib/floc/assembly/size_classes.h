#pragma once

#include <optional>
#include <vector>

#include "floc/assembly/assembly_options.h"

namespace floc {

/// Interval of diameters, and what the grains of a scene hold in it beside what its distribution asks for. Shares are
/// fractions of the volume (area in 2D) of all grains, of bodies with corners that of the circumscribed spheres (circles).
struct SizeClass {
  double from = 0.0,
         to = 0.0;  ///< ends of the interval (length); it contains `to`, and the first one also `from`
  int n_grains = 0;
  double share = 0.0;    ///< share of the grains of the interval
  double passing = 0.0;  ///< share of all grains up to `to`
  /// both shares as the distribution asks for them; absent for distributions of single diameters
  std::optional<double> share_asked, passing_asked;
};

/// Returns the classes of sizes of grains: the intervals between the sieves of a sieve curve, for other distributions
/// the quarters of their range of diameters. Grains of one size have no classes.
/// @param distribution  distribution from which the grains were drawn
/// @param diameters  diameters of the grains (length)
/// @param dimension  2 for disks, 3 for spheres
std::vector<SizeClass> size_classes(const DiameterDistribution& distribution,
                                    const std::vector<double>& diameters, int dimension);

/// Returns the classes of sizes of the grains that a scene draws.
std::vector<SizeClass> size_classes(const GrainOptions& grains, int dimension);

/// Returns the quarters of the range of diameters of the grains that a scene draws.
std::vector<SizeClass> size_quarters(const GrainOptions& grains, int dimension);

}  // namespace floc
