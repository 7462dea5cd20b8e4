#pragma once

#include "floc/picture/packing_picture.h"

namespace floc {

/// Factors that convert lengths, forces and displacements of a picture to points on the page.
struct DrawnScale {
  double points_per_length = 1.0;
  double points_per_force = 0.0;  ///< line width of a unit force (points)
  double points_per_displacement = 0.0;
};

/// Returns the mean diameter of the grains of a picture (length). The diameter of a grain with corners is the diameter
/// of the disk or sphere of equal volume.
template <int Dim>
double mean_diameter(const PackingPicture<Dim>& picture);

/// Returns the root mean square of all positive forces that the lines of a picture show; 0 if there are none.
template <int Dim>
double rms_force(const PackingPicture<Dim>& picture);

/// Returns the root mean square of the displacements that the arrows of a picture show; 0 if there are none.
template <int Dim>
double rms_displacement(const PackingPicture<Dim>& picture);

/// Returns the largest number that is 1, 2 or 5 times a power of ten and not above x. @pre x > 0
double round_number_below(double x);

/// Formats a number with at most three significant digits: "13.3", "0.01", "2×10⁻⁵".
std::string short_number(double x);

}  // namespace floc
