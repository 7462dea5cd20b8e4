#include "floc/io/listed_shapes.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "floc/io/listed_packing.h"

namespace floc {
namespace {

template <int Dim>
Mat<Dim> plane_of(const Eigen::Matrix3d& turn) {
  return turn.topLeftCorner<Dim, Dim>();
}

template <int Dim>
void set_shape_in(const Shape<Dim>& shape, const Eigen::Vector3d& origin, const Eigen::Matrix3d& turn,
                  ListedGrain& grain) {
  ListedPose& pose = *grain.pose;
  grain.position = origin;
  grain.position.head<Dim>() += pose.scale * (plane_of<Dim>(turn) * shape.centre);
  grain.radius = pose.scale * shape.outer_radius;
  pose.axes.topLeftCorner<Dim, Dim>() = plane_of<Dim>(turn) * shape.axes;
}

/// For a shape centred at the origin, returns the largest coordinate (length) of its points along a direction.
template <int Dim>
double reach_of(const Shape<Dim>& shape, const ListedPose& pose, const Vec<Dim>& direction) {
  return pose.scale * extent<Dim>(shape, plane_of<Dim>(pose.axes).transpose() * direction);
}

Orientation<2> orientation_of(const Mat<2>& axes) {
  return std::atan2(axes(1, 0), axes(0, 0));
}
Orientation<3> orientation_of(const Mat<3>& axes) {
  return Eigen::Quaterniond(axes).normalized();
}

}  // namespace

void set_shape(const ListedShapes& shapes, int shape, double scale, const Eigen::Vector3d& origin,
               const Eigen::Matrix3d& turn, ListedGrain& grain) {
  grain.pose = ListedPose{shape, scale};
  if (shapes.in_3d.empty())
    set_shape_in<2>(shapes.in_2d[static_cast<std::size_t>(shape)], origin, turn, grain);
  else
    set_shape_in<3>(shapes.in_3d[static_cast<std::size_t>(shape)], origin, turn, grain);
}

double reach_along(const ListedPacking& listed, const ListedGrain& grain, int axis, int side) {
  if (!grain.pose) return grain.radius;
  const auto shape = static_cast<std::size_t>(grain.pose->shape);
  if (listed.shapes.in_3d.empty())
    return reach_of<2>(listed.shapes.in_2d[shape], *grain.pose, side * Vec<2>::Unit(axis));
  return reach_of<3>(listed.shapes.in_3d[shape], *grain.pose, side * Vec<3>::Unit(axis));
}

template <int Dim>
void set_shapes(const ListedPacking& listed, Grains<Dim>& grains) {
  if (listed.shapes.empty()) return;
  grains.shapes = std::make_shared<const std::vector<Shape<Dim>>>(listed.shapes.table<Dim>());
  for (std::size_t i = 0; i < listed.grains.size(); ++i) {
    const ListedPose& pose = *listed.grains[i].pose;
    grains.shape.push_back(pose.shape);
    grains.scale.push_back(pose.scale);
    grains.orientation[i] = orientation_of(plane_of<Dim>(pose.axes));
  }
}

template void set_shapes(const ListedPacking&, Grains<2>&);
template void set_shapes(const ListedPacking&, Grains<3>&);

}  // namespace floc
