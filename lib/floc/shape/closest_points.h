#pragma once

#include "floc/shape/placed_shape.h"

namespace floc {

/// Closest points of two cores, in the own coordinates of the first.
template <int Dim>
struct ClosestPoints {
  bool overlap = false;                ///< the cores meet: the rest is not set
  double distance = 0.0;               ///< > 0
  Vec<Dim> normal = Vec<Dim>::Zero();  ///< unit vector from the first core to the second
  Vec<Dim> on_first = Vec<Dim>::Zero(), on_second = Vec<Dim>::Zero();
  int n_first = 0;   ///< corners that span the feature with the point: 1 a vertex, 2 an edge, 3 a face
  int n_second = 0;  ///< number of such corners of the second core
};

/// Closest points by Gilbert, Johnson and Keerthi (IEEE J. Robot. Autom. 4, 1988). A core without vertices is a
/// point.
///
/// Positions are right to a few times rounding times the size of the shapes, the normal to that over the
/// distance. Cores nearer than 1e-12 of their size count as overlapping.
///
/// @param guess  direction from the first core to the second near that of the closest points, of any length > 0
template <int Dim>
ClosestPoints<Dim> closest_points(const Shape<Dim>& first, const Shape<Dim>& second,
                                  const RelativePlace<Dim>& place, const Vec<Dim>& guess);

}  // namespace floc
