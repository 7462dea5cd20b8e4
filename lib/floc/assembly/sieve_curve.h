#pragma once

#include <vector>

namespace floc {

/// Grading curve of a sieve analysis: for each size of a list, the mass of the grains finer than this size, as a
/// percentage of the mass of all grains. Between two sizes of the list, the percentage is a linear function of ln d,
/// with the diameter d of a grain: equal intervals of ln d contain equal masses. The mass of a grain is proportional to
/// d^Dim, so the number of grains of diameter d is proportional to d^-(Dim + 1).
struct SieveCurve {
  std::vector<double> sizes;  ///< sizes of the openings of the sieves, increasing (length)
  /// mass finer than each size, as a percentage of the whole mass, from 0 to 100, not decreasing
  std::vector<double> passing;
};

/// Returns the mass of the grains finer than a diameter as a fraction of the whole mass, from 0 to 1. The fraction is
/// interpolated linearly in the logarithm of the diameter. Below the smallest size of the curve, the result is 0; above
/// the largest size, it is the fraction at the largest size.
double passing_at(const SieveCurve& curve, double diameter);

/// Returns the part of a curve between the diameters `min` and `max`. Its percentages refer to the mass of the grains
/// between these two diameters.
/// @param min, max  diameters with min < max (length); passing_at() must be smaller at `min` than at `max`
SieveCurve cut_curve(const SieveCurve& curve, double min, double max);

/// Returns the diameter below which a given fraction of the number of grains lies (length).
/// @param dimension  2 for disks, 3 for spheres
/// @param share  fraction of the number of grains, 0 to 1
double number_quantile(const SieveCurve& curve, int dimension, double share);

}  // namespace floc
