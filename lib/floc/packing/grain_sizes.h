#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Largest diameter, the unit of length a of a packing (length); 0 without grains.
/// @param radius  of each grain (length)
inline double largest_diameter(const std::vector<double>& radius) {
  return radius.empty() ? 0.0 : 2.0 * *std::max_element(radius.begin(), radius.end());
}

template <int Dim>
double largest_diameter(const Grains<Dim>& grains) {
  return largest_diameter(grains.radius);
}

/// Mean diameter of grains (length). @pre there are grains
inline double mean_diameter(const std::vector<double>& radius) {
  return 2.0 * std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
}

/// Largest mass of a grain (mass). @pre there are grains
template <int Dim>
double largest_mass(const Grains<Dim>& grains) {
  return *std::max_element(grains.mass.begin(), grains.mass.end());
}

/// Largest ratio of diameters up to which one length, the largest diameter, is used for all grains in searches
/// for neighbours and in scales of forces. Beyond it, both use the size of each grain.
inline constexpr double kSimilarSizes = 4.0;

inline bool similar_sizes(const std::vector<double>& radius) {
  if (radius.empty()) return true;
  const auto [least, most] = std::minmax_element(radius.begin(), radius.end());
  return *most <= kSimilarSizes * *least;
}

/// Unit of the skin of neighbour lists (length): the largest diameter, or the smallest one where sizes are not
/// similar, since a skin that is thin for the largest grains contains whole layers of the smallest.
inline double skin_length_unit(const std::vector<double>& radius) {
  return similar_sizes(radius) ? largest_diameter(radius)
                               : 2.0 * *std::min_element(radius.begin(), radius.end());
}

}  // namespace floc
