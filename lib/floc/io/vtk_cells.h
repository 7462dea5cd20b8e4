#pragma once

#include <Eigen/Core>

#include "floc/base/vec.h"

/// Constants and functions for all formats of VTK.
namespace floc {

/// Types of cells in files of VTK.
inline constexpr int kVertexCell = 1, kLineCell = 3, kPolygonCell = 7, kPolyhedronCell = 42;

/// Returns a vector in three dimensions. In 2D its third component is zero.
template <int Dim>
Eigen::Vector3d in_space(const Vec<Dim>& v) {
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  out.head<Dim>() = v;
  return out;
}

}  // namespace floc
