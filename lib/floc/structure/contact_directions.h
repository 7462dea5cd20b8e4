#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// How often contacts of disks point in a direction, for a rose diagram. Opposite directions are the same one.
struct ContactDirections {
  int n_bins = 0;              ///< from 0 to pi, equally wide
  std::vector<double> all;     ///< density of each bin: 1/pi everywhere where directions are isotropic
  std::vector<double> strong;  ///< the part of contacts whose normal force is above the mean
  int n_contacts = 0;
};

/// Directions of the contacts that touch and press.
ContactDirections contact_directions(const Packing<2>& packing, int n_bins);

}  // namespace floc
