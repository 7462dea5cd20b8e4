#pragma once

#include <Eigen/Geometry>

#include "floc/packing/packing.h"

namespace floc {

/// Returns an orientation after a rotation.
/// @param angle  rotation vector (radians)
inline Orientation<2> turned(const Orientation<2>& orientation, const RotationVector<2>& angle) {
  return orientation + angle[0];
}
inline Orientation<3> turned(const Orientation<3>& orientation, const RotationVector<3>& angle) {
  const double size = angle.norm();
  if (size == 0.0) return orientation;
  return (Eigen::Quaterniond(Eigen::AngleAxisd(size, angle / size)) * orientation).normalized();
}

/// Returns a vector after a rotation.
/// @param angle  rotation vector (radians)
inline Vec<2> rotated(const Vec<2>& vector, const RotationVector<2>& angle) {
  return Eigen::Rotation2Dd(angle[0]) * vector;
}
inline Vec<3> rotated(const Vec<3>& vector, const RotationVector<3>& angle) {
  return turned(Eigen::Quaterniond::Identity(), angle) * vector;
}

}  // namespace floc
