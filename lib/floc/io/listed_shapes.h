#pragma once

#include <Eigen/Core>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/shape/shape.h"

namespace floc {

struct ListedGrain;
struct ListedPacking;

/// Shapes of the grains in a listed packing: one table for two and one for three dimensions. Only the table for the
/// dimension of the packing is used. Both tables are empty if all grains are disks or spheres.
struct ListedShapes {
  std::vector<Shape<2>> in_2d;
  std::vector<Shape<3>> in_3d;

  bool empty() const { return in_2d.empty() && in_3d.empty(); }
  template <int Dim>
  const std::vector<Shape<Dim>>& table() const {
    if constexpr (Dim == 2)
      return in_2d;
    else
      return in_3d;
  }
};

/// Shape of a listed grain, and its orientation.
struct ListedPose {
  int shape = 0;       ///< index in the table of shapes
  double scale = 1.0;  ///< factor by which the shape is magnified
  /// Axes of the shape in space, one per column. The matrix rotates a vector from the coordinates of the shape to the
  /// coordinates of space. In 2D the third axis is z.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// Assigns a shape to a listed grain, that is, sets the position (the centre of mass), the radius and the pose of the
/// grain.
/// @param shape  index of the shape in the table for the dimension of the packing
/// @param scale  factor by which the shape is magnified, > 0
/// @param origin  position (length) in space of the point that was the origin of the coordinates when the shape was
/// made
/// @param turn  rotation from the coordinates in which the shape was made to the coordinates of space
void set_shape(const ListedShapes& shapes, int shape, double scale, const Eigen::Vector3d& origin,
               const Eigen::Matrix3d& turn, ListedGrain& grain);

/// Returns the largest distance (length), along an axis, from the centre of a grain to a point of the grain.
/// @param side  1: in the direction of the axis; -1: in the opposite direction
double reach_along(const ListedPacking& listed, const ListedGrain& grain, int axis, int side);

/// Copies the shapes, scales and orientations of the listed grains to `grains`. Does nothing if all grains are round.
/// @pre `grains` has as many grains as `listed`
template <int Dim>
void set_shapes(const ListedPacking& listed, Grains<Dim>& grains);

}  // namespace floc
