#pragma once

#include "floc/geometry/frame.h"

namespace floc {

/// Rotation of a 3D contact in a short time step. It rotates the elongation of the tangential spring of the contact:
/// first by the smallest rotation that takes the old normal n0 to the new normal n1, then about n1 by the mean rotation
/// of the two grains. Lengths do not change, and the angle about the normal is correct to second order. The sixth and
/// higher powers of the angles (radians) are neglected, so no roots or divisions are needed.
template <class T>
class FrameTurn {
 public:
  FrameTurn() = default;
  /// @param normal     unit normal of the contact after the step
  /// @param along      component along `normal` of a vector c. c is the change, during the step, of the vector between
  /// the centres of the grains, divided by the distance of the centres after the step
  /// @param across     part of c in the tangent plane
  /// @param spins      sum of the angular velocities of the two grains (radians/time)
  /// @param time_step  duration of the step (time)
  FrameTurn(const Vec<3, T>& normal, const T& along, const Vec<3, T>& across, const RotationVector<3, T>& spins,
            const T& time_step)
      : n_(normal), across_(across) {
    // Let n1 be the new normal, tilt = 1/(1 - along) (computed as a series), w = tilt * across, and s = w^2. Then the
    // old normal is n0 = (n1 - w)/sqrt(1 + s).
    const T tilt = T(1) + along * (T(1) + along * (T(1) + along));
    const T across_squared = across.squaredNorm();
    const T s = tilt * tilt * across_squared;
    // The mean normal is (n0 + n1)/(1 + n0.n1) = n1 - w/(1 + sqrt(1 + s)), with w and s as above. The code writes the
    // mean normal as n1 - lean * across and computes `lean` as a series in s.
    lean_ = tilt * (T(0.5) - s * (T(0.125) - T(0.0625) * s));
    along_middle_ = along - lean_ * across_squared;
    mean_normal_ = n_ - lean_ * across;
    const T half_angle = T(0.25) * time_step * spins.dot(mean_normal_);
    const T squared = half_angle * half_angle;
    const T scale = T(1) - squared * (T(1) - squared);  // approximates 1/(1 + squared)
    sin_ = T(2) * half_angle * scale;
    cos_ = (T(1) - squared) * scale;
  }

  /// Returns the mean of the old and the new normal. The mean is not a unit vector: its length differs from 1 by a term
  /// of second order in the angle between the two normals.
  const Vec<3, T>& mean_normal() const { return mean_normal_; }

  /// Returns the slip of the two surfaces in the step (length): P1 Pm (d - s x m). Here d is the change of the vector
  /// between the centres of the grains, s is `surfaces`, and m is the mean normal. Pm projects onto the plane normal to
  /// m, and P1 onto the plane normal to the new normal n1.
  /// @param length    distance of the centres of the grains after the step
  /// @param surfaces  lever arm of grain i times the rotation of grain i in the step, plus the same product for grain j
  Vec<3, T> slip(const T& length, const RotationVector<3, T>& surfaces) const {
    // The mean normal is m = n1 - lean across. With lengths in units of `length`, the two terms of the slip are P1 Pm d
    // = (1 + lean m.d) across and P1 (s x m) = (s + lean (s.n1) across) x n1.
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
  // component along m of c, the change of the vector between the centres divided by the distance of the centres
  T along_middle_;
};

}  // namespace floc
