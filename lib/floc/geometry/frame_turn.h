#pragma once

#include "floc/geometry/frame.h"

namespace floc {

/// Rotation of a 3D contact in a short time step. It rotates the elongation of the tangential spring of the contact:
/// first by the smallest rotation that takes the old normal n0 to the new normal n1, then about n1 by the mean rotation
/// of the two grains. Lengths do not change, and the angle about the normal is correct to second order. Powers of the
/// angles (radians) from the sixth on are neglected, which avoids roots and divisions.
template <class T>
class FrameTurn {
 public:
  FrameTurn() = default;
  /// @param normal     unit normal of the contact after the step
  /// @param along      change of the vector between the centres of the grains in the step: its component along
  /// `normal`, divided by the distance of the centres after the step
  /// @param across     change of the vector between the centres of the grains in the step: its part in the tangent
  /// plane, divided by the distance of the centres after the step
  /// @param spins      sum of the angular velocities of the two grains (radians/time)
  /// @param time_step  duration of the step (time)
  FrameTurn(const Vec<3, T>& normal, const T& along, const Vec<3, T>& across, const RotationVector<3, T>& spins,
            const T& time_step)
      : n_(normal), across_(across) {
    // With w = across/(1 - along) = tilt * across and the new normal n1, the old normal is n0 = (n1 - w)/sqrt(1 + w^2).
    // s is w^2.
    const T tilt = T(1) + along * (T(1) + along * (T(1) + along));
    const T across_squared = across.squaredNorm();
    const T s = tilt * tilt * across_squared;
    // The mean normal is (n0 + n1)/(1 + n0.n1) = n1 - w/(1 + sqrt(1 + s)), with w and s as above. It is written as n1 -
    // lean * across, and `lean` is computed as a series in s.
    lean_ = tilt * (T(0.5) - s * (T(0.125) - T(0.0625) * s));
    along_middle_ = along - lean_ * across_squared;
    mean_normal_ = n_ - lean_ * across;
    const T half_angle = T(0.25) * time_step * spins.dot(mean_normal_);
    const T squared = half_angle * half_angle;
    const T scale = T(1) - squared * (T(1) - squared);  // approximates 1/(1 + squared)
    sin_ = T(2) * half_angle * scale;
    cos_ = (T(1) - squared) * scale;
  }

  /// Returns the mean of the old and the new normal. Its length differs from 1 by the square of the angle between the
  /// two normals.
  const Vec<3, T>& mean_normal() const { return mean_normal_; }

  /// Returns the slip of the two surfaces in the step (length): P1 Pm (d - s x m). Here d is the change of the vector
  /// between the centres of the grains, s is `surfaces`, and m is the mean normal. Pm and then P1 project onto the
  /// planes normal to m and to the new normal n1.
  /// @param length    distance of the centres of the grains after the step
  /// @param surfaces  lever arm of grain i times its rotation in the step, plus lever arm of grain j times its rotation
  Vec<3, T> slip(const T& length, const RotationVector<3, T>& surfaces) const {
    // With the mean normal m = n1 - lean across, the two terms of the slip are P1 Pm d = (1 + lean m.d) across and P1
    // (s x m) = (s + lean (s.n1) across) x n1.
    const RotationVector<3, T> about = surfaces + (lean_ * surfaces.dot(n_)) * across_;
    return (length * (T(1) + lean_ * along_middle_)) * across_ - cross<T>(about, n_);
  }

  /// Returns the vector v after the rotation.
  /// @param v  vector normal to the old normal of the contact
  Vec<3, T> operator()(const Vec<3, T>& v) const {
    const Vec<3, T> turned = v - v.dot(n_) * mean_normal_;
    return cos_ * turned + sin_ * moment<T>(n_, turned);
  }

 private:
  Vec<3, T> n_, mean_normal_;
  T cos_, sin_;
  Vec<3, T> across_;
  T lean_;  // coefficient `lean` in the mean normal m = n1 - lean across
  // component along m of the change of the vector between the centres, divided by their distance
  T along_middle_;
};

}  // namespace floc
