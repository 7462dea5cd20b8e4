#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Distribution of the directions of the contact normals in a packing of disks, for a polar histogram. Opposite
/// directions count as equal.
struct ContactDirections {
  int n_bins = 0;  ///< number of bins of equal width from 0 to pi
  /// Probability density in each bin (1/radian): 1/pi in all bins if the directions are isotropic.
  std::vector<double> all;
  std::vector<double> strong;  ///< contribution to `all` of the contacts whose normal force is above the mean
  int n_contacts = 0;
};

/// Returns the distribution of the directions of contacts in compression.
/// @param n_bins  number of bins from 0 to pi
ContactDirections contact_directions(const Packing<2>& packing, int n_bins);

}  // namespace floc
