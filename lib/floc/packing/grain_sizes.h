#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns the largest diameter of the grains of a packing (length), called a in formulas; 0 if there are no grains.
/// @param radius  radius of each grain (length)
inline double largest_diameter(const std::vector<double>& radius) {
  return radius.empty() ? 0.0 : 2.0 * *std::max_element(radius.begin(), radius.end());
}

template <int Dim>
double largest_diameter(const Grains<Dim>& grains) {
  return largest_diameter(grains.radius);
}

/// Returns the radius of the smaller grain of a contact, or of the grain that touches a wall (length).
template <int Dim>
double smaller_radius(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  const std::vector<double>& radius = packing.grains.radius;
  return packing.is_wall(contact.j) ? radius[contact.i] : std::min(radius[contact.i], radius[contact.j]);
}

/// Returns the mean diameter of all grains (length).
/// @pre there are grains
inline double mean_diameter(const std::vector<double>& radius) {
  return 2.0 * std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
}

/// Returns the largest mass of any grain (mass).
/// @pre there are grains
template <int Dim>
double largest_mass(const Grains<Dim>& grains) {
  return *std::max_element(grains.mass.begin(), grains.mass.end());
}

/// Returns the total mass of all grains (mass).
template <int Dim>
double total_mass(const Grains<Dim>& grains) {
  return std::accumulate(grains.mass.begin(), grains.mass.end(), 0.0);
}

/// Returns the total volume of all grains, in 2D their total area (length^Dim). Overlaps count twice.
template <int Dim>
double total_volume(const Grains<Dim>& grains) {
  double volume = 0.0;
  for (int i = 0; i < grains.size(); ++i) volume += grains.volume(i);
  return volume;
}

/// The grains of a packing count as similar in size if the largest diameter is at most this number times the smallest
/// diameter. If so, the search for neighbours and the force scale use the largest diameter for all grains; otherwise
/// they use the diameter of each grain.
inline constexpr double kSimilarSizes = 4.0;

inline bool similar_sizes(const std::vector<double>& radius) {
  if (radius.empty()) return true;
  const auto [least, most] = std::minmax_element(radius.begin(), radius.end());
  return *most <= kSimilarSizes * *least;
}

/// Returns the unit of length for the skin of neighbour lists: the largest diameter or, if the grains are not similar
/// in size, the smallest diameter. The largest diameter would be too large a unit in this case: a skin that is thin for
/// the largest grains would contain whole layers of the smallest grains.
inline double skin_length_unit(const std::vector<double>& radius) {
  return similar_sizes(radius) ? largest_diameter(radius)
                               : 2.0 * *std::min_element(radius.begin(), radius.end());
}

}  // namespace floc
