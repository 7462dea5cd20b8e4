#pragma once

#include "floc/geometry/frame.h"

namespace floc {

/// Rotation of the frame of a 3D contact in a short time step, applied to the tangential history of the contact. It is
/// the smallest rotation that takes the old normal n0 to the new normal n1, followed by a rotation about n1 by the mean
/// rotation of the two grains. The rotation keeps lengths, and its angle about the normal is correct to second order.
/// Powers of the angle (radians) from the sixth on are neglected, so that no root or division is needed.
template <class T>
class FrameTurn {
 public:
  FrameTurn() = default;
  /// @param normal     unit normal after the step
  /// @param along      displacement of the branch vector in the step: its component along the normal, over the branch
  /// length after the step
  /// @param across     displacement of the branch vector in the step: its part normal to the normal, over the branch
  /// length after the step
  /// @param spins      sum of the spins of the two grains (radians/time)
  /// @param time_step  duration of the step (time)
  FrameTurn(const Vec<3, T>& normal, const T& along, const Vec<3, T>& across, const RotationVector<3, T>& spins,
            const T& time_step)
      : n_(normal), across_(across) {
    // The old normal is n0 = (n1 - w)/sqrt(1 + w^2), with the new normal n1 and the vector
    // w = across/(1 - along) = tilt * across, of which s = w^2.
    const T tilt = T(1) + along * (T(1) + along * (T(1) + along));
    const T across_squared = across.squaredNorm();
    const T s = tilt * tilt * across_squared;
    // The mean normal is (n0 + n1)/(1 + n0.n1) = n1 - w/(1 + sqrt(1 + s)) = n1 - lean * across: a series in s.
    lean_ = tilt * (T(0.5) - s * (T(0.125) - T(0.0625) * s));
    along_middle_ = along - lean_ * across_squared;
    mean_normal_ = n_ - lean_ * across;
    const T half_angle = T(0.25) * time_step * spins.dot(mean_normal_);
    const T squared = half_angle * half_angle;
    const T scale = T(1) - squared * (T(1) - squared);  // 1/(1 + squared)
    sin_ = T(2) * half_angle * scale;
    cos_ = (T(1) - squared) * scale;
  }

  /// Returns the normal half way between the old and the new one; its length is 1 up to the square of the angle between
  /// them.
  const Vec<3, T>& mean_normal() const { return mean_normal_; }

  /// Returns the slip of the two surfaces in the step: the part normal to the mean normal m, projected onto the plane
  /// normal to the new normal n1. With d the displacement of the branch vector it is P1 Pm (d - s x m). P1 and Pm
  /// project onto the planes normal to n1 and to m.
  /// @param length    length of the branch after the step
  /// @param surfaces  s, displacement of the surface of grain i relative to grain j by rotation: sum of arms times
  /// rotations
  Vec<3, T> slip(const T& length, const RotationVector<3, T>& surfaces) const {
    // With the mean normal m = n1 - lean across, the two terms of the slip are P1 Pm d = (1 + lean m.d) across and P1
    // (s x m) = (s + lean (s.n1) across) x n1, where P1 and Pm project onto the planes normal to n1 and to m.
    const RotationVector<3, T> about = surfaces + (lean_ * surfaces.dot(n_)) * across_;
    return (length * (T(1) + lean_ * along_middle_)) * across_ - cross<T>(about, n_);
  }

  /// Returns a vector after the rotation. @param v  vector normal to the old normal
  Vec<3, T> operator()(const Vec<3, T>& v) const {
    const Vec<3, T> turned = v - v.dot(n_) * mean_normal_;
    return cos_ * turned + sin_ * moment<T>(n_, turned);
  }

 private:
  Vec<3, T> n_, mean_normal_;
  T cos_, sin_;
  Vec<3, T> across_;
  T lean_;          // coefficient `lean` in the mean normal m = n1 - lean across
  T along_middle_;  // displacement of the branch vector along m over the branch length
};

}  // namespace floc
