#pragma once

#include "floc/geometry/frame.h"

namespace floc {

/// How the frame of a 3D contact turns in a short step, for the tangential quantities that a contact remembers:
/// by the smallest rotation that takes the old normal n0 to the new one, n1, then about n1 by the mean rotation
/// of the two grains. Lengths stay as they are, and the angle about the normal is right to second order. Powers
/// of the turn (radians) from the sixth on are left out, so that no root or division is needed.
template <class T>
class FrameTurn {
 public:
  FrameTurn() = default;
  /// @param normal           after the step
  /// @param displacement     of the branch in the step, over its length after it
  /// @param twice_rotation   sum of the rotations of the two grains (radians)
  FrameTurn(const Vec<3, T>& normal, const Vec<3, T>& displacement, const RotationVector<3, T>& twice_rotation)
      : n_(normal) {
    const T along = n_.dot(displacement);
    // n0 = (n1 - tilt)/sqrt(1 + tilt^2), tilt = (displacement across n1)/(1 - along).
    const Vec<3, T> tilt = (displacement - along * n_) * (T(1) + along * (T(1) + along * (T(1) + along)));
    const T s = tilt.squaredNorm();
    // (n0 + n1)/(1 + n0.n1) = n1 - tilt/(1 + sqrt(1 + tilt^2))
    mean_normal_ = n_ - tilt * (T(0.5) - s * (T(0.125) - T(0.0625) * s));
    const T half_angle = T(0.25) * twice_rotation.dot(mean_normal_);
    const T squared = half_angle * half_angle;
    const T scale = T(1) - squared * (T(1) - squared);  // 1/(1 + squared)
    cos_ = (T(1) - squared) * scale;
    sin_ = T(2) * half_angle * scale;
  }

  /// Half way between the old normal and the new, of length 1 up to the square of the angle between them.
  const Vec<3, T>& mean_normal() const { return mean_normal_; }

  /// @param v  normal to the old normal
  Vec<3, T> operator()(const Vec<3, T>& v) const {
    const Vec<3, T> turned = v - v.dot(n_) * mean_normal_;
    return cos_ * turned + sin_ * moment<T>(n_, turned);
  }

 private:
  Vec<3, T> n_, mean_normal_;
  T cos_, sin_;
};

}  // namespace floc
