#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Distribution of the directions of contacts of disks, for a rose diagram. Opposite directions are not
/// distinguished.
struct ContactDirections {
  int n_bins = 0;              ///< from 0 to pi, equally wide
  std::vector<double> all;     ///< density of each bin: 1/pi everywhere where directions are isotropic
  std::vector<double> strong;  ///< part of `all` due to contacts whose normal force is above the mean
  int n_contacts = 0;
};

/// Returns the directions of the touching contacts in compression. @param n_bins  number of bins from 0 to pi
ContactDirections contact_directions(const Packing<2>& packing, int n_bins);

}  // namespace floc
