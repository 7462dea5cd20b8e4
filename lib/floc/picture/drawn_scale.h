#pragma once

#include "floc/picture/packing_picture.h"

namespace floc {

/// How lengths and forces of a picture become points on the page.
struct DrawnScale {
  double points_per_length = 1.0;
  double points_per_force = 0.0;  ///< line width of a unit force
  double points_per_displacement = 0.0;
};

template <int Dim>
double mean_diameter(const PackingPicture<Dim>& picture);

/// Root mean square of the forces of all lines that have one; 0 without.
template <int Dim>
double rms_force(const PackingPicture<Dim>& picture);

/// Root mean square length of all arrows; 0 without.
template <int Dim>
double rms_displacement(const PackingPicture<Dim>& picture);

/// 1, 2 or 5 times a power of ten, the largest that is not above x > 0.
double round_number_below(double x);

/// A number in few characters: "13.3", "0.01", "2×10⁻⁵".
std::string short_number(double x);

}  // namespace floc
