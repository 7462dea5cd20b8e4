#pragma once

#include "floc/shape/placed_shape.h"

namespace floc {

/// Closest points of the cores of two shapes (the shapes without their rounding), in the coordinates of the
/// first shape.
template <int Dim>
struct ClosestPoints {
  /// whether the two cores overlap; if so, the other members are not set
  bool overlap = false;
  double distance = 0.0;  ///< distance of the closest points (length), > 0
  /// unit vector from the closest point of the first core to that of the second core
  Vec<Dim> normal = Vec<Dim>::Zero();
  Vec<Dim> on_first = Vec<Dim>::Zero(), on_second = Vec<Dim>::Zero();
  /// Kind of feature on which the closest point of the first core lies, as a number of vertices: 1 for a vertex, 2 for
  /// an edge, 3 for a face.
  int n_first = 0;
  /// kind of feature on which the closest point of the second core lies, as for n_first: 1, 2 or 3
  int n_second = 0;
};

/// Computes the closest points of the cores of two shapes (the shapes without their rounding) by the algorithm
/// of Gilbert, Johnson and Keerthi (IEEE J. Robot. Autom. 4, 1988). A core without vertices is a point.
///
/// The error of the points is a few times the machine precision (2e-16) times the size of the shapes. The error of the
/// normal is the error of the points divided by their distance. Two cores count as overlapping if their distance,
/// divided by the size of the shapes, is below 1e-12.
///
/// @param guess  estimate of the direction from the closest point of the first core to that of the second core; vector
/// of any length > 0
template <int Dim>
ClosestPoints<Dim> closest_points(const Shape<Dim>& first, const Shape<Dim>& second,
                                  const RelativePlace<Dim>& place, const Vec<Dim>& guess);

}  // namespace floc
