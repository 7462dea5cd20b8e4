#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// The unit of length a of a packing; 0 without grains. @param radius  (length)
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

/// The largest ratio of diameters at which one length, the largest diameter, serves for all grains, in searches
/// for neighbours and as a scale of forces. Beyond it, both go by the size of the grain.
inline constexpr double kSimilarSizes = 4.0;

inline bool similar_sizes(const std::vector<double>& radius) {
  if (radius.empty()) return true;
  const auto [least, most] = std::minmax_element(radius.begin(), radius.end());
  return *most <= kSimilarSizes * *least;
}

/// Length in which the skin of neighbour lists is measured: the largest diameter, or the smallest where they
/// differ much, since a skin that is thin for the largest grains holds whole layers of the smallest.
inline double skin_length_unit(const std::vector<double>& radius) {
  return similar_sizes(radius) ? largest_diameter(radius)
                               : 2.0 * *std::min_element(radius.begin(), radius.end());
}

}  // namespace floc
