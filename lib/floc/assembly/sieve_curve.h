#pragma once

#include <vector>

namespace floc {

/// Grading curve of a sieve analysis: the percentage of the mass of all grains that is finer than each of some sizes.
/// Between two sizes the percentage is a linear function of ln d, so that equal intervals of ln d contain equal masses,
/// and the number of grains of diameter d goes as d^-(Dim + 1): the mass of a sphere goes as d^3, that of a disk as
/// d^2.
struct SieveCurve {
  std::vector<double> sizes;    ///< sizes of the openings, increasing (length)
  std::vector<double> passing;  ///< percentage of the mass finer than each size, from 0 to 100, not decreasing
};

/// Returns the fraction of the mass, 0 to 1, that is finer than a diameter, by log-linear interpolation: 0 below the
/// smallest size of the curve, that of the largest size above it.
double passing_at(const SieveCurve& curve, double diameter);

/// Returns the curve of the grains with diameters from `min` to `max` alone: their mass counts as the whole.
/// @param min, max  diameters with min < max (length); passing_at() must be smaller at `min` than at `max`
SieveCurve cut_curve(const SieveCurve& curve, double min, double max);

/// Returns the diameter below which a given fraction of the number of grains lies (length).
/// @param dimension  2 for disks, 3 for spheres
/// @param share  fraction of the number of grains, 0 to 1
double number_quantile(const SieveCurve& curve, int dimension, double share);

}  // namespace floc
