#pragma once

#include <cmath>

#include "floc/base/vec.h"

namespace floc {

/// Number of components of a tangential displacement. In 2D the displacement is one number, its component along the
/// tangent. In 3D it is a vector in space, normal to the contact normal.
template <int Dim>
inline constexpr int kShearComponents = Dim == 2 ? 1 : 3;

/// Tangential displacement or force of a contact: in 2D its component along the tangent, in 3D a vector in space.
template <int Dim, class T = double>
using Shear = Eigen::Matrix<T, kShearComponents<Dim>, 1>;

/// Returns the tangent of a 2D contact: the normal turned by +90 degrees.
template <class T>
inline Vec<2, T> tangent(const Vec<2, T>& n) {
  return {-n[1], n[0]};
}

/// Returns spin x arm. This is the velocity of a point at the position `arm` relative to the centre of a grain that
/// rotates with the angular velocity `spin`.
template <class T>
inline Vec<2, T> cross(const RotationVector<2, T>& spin, const Vec<2, T>& arm) {
  return spin[0] * tangent(arm);
}
template <class T>
inline Vec<3, T> cross(const RotationVector<3, T>& spin, const Vec<3, T>& arm) {
  return {spin[1] * arm[2] - spin[2] * arm[1], spin[2] * arm[0] - spin[0] * arm[2],
          spin[0] * arm[1] - spin[1] * arm[0]};
}

/// Returns arm x force. This is the moment, about the centre of a grain, of a force that acts at the position `arm`
/// relative to this centre.
template <class T>
inline RotationVector<2, T> moment(const Vec<2, T>& arm, const Vec<2, T>& force) {
  return RotationVector<2, T>(arm[0] * force[1] - arm[1] * force[0]);
}
template <class T>
inline RotationVector<3, T> moment(const Vec<3, T>& arm, const Vec<3, T>& force) {
  return cross<T>(RotationVector<3, T>(arm), force);
}

/// Returns the tangential part of a relative displacement at a contact with unit normal n: in 2D its component along
/// the tangent, in 3D a vector in space.
template <class T>
inline Shear<2, T> to_shear(const Vec<2, T>& n, const Vec<2, T>& displacement) {
  return Shear<2, T>(tangent(n).dot(displacement));
}
template <class T>
inline Shear<3, T> to_shear(const Vec<3, T>& n, const Vec<3, T>& displacement) {
  return displacement - n * n.dot(displacement);
}

/// Converts a tangential displacement or force at a contact with unit normal n to a vector in space.
template <class T>
inline Vec<2, T> from_shear(const Vec<2, T>& n, const Shear<2, T>& shear) {
  return tangent(n) * shear[0];
}
template <class T>
inline Vec<3, T> from_shear(const Vec<3, T>&, const Shear<3, T>& shear) {
  // The components are listed one by one: GCC would copy a whole vector through memory.
  return {shear[0], shear[1], shear[2]};
}

/// Returns the rolling part of a relative rotation at a contact with unit normal n: in 2D the whole rotation, in 3D the
/// part of the rotation vector that is normal to n.
template <class T>
inline RotationVector<2, T> rolling_part(const Vec<2, T>&, const RotationVector<2, T>& rotation) {
  return rotation;
}
template <class T>
inline RotationVector<3, T> rolling_part(const Vec<3, T>& n, const RotationVector<3, T>& rotation) {
  return to_shear<T>(n, rotation);
}

/// Rotates the elongation of the tangential or rolling spring of a contact whose unit normal has changed from n0 to n1.
/// In 2D the elongation is a component along the tangent and does not change. In 3D it is a vector: it is rotated first
/// by the smallest rotation that takes n0 to n1, then about n1 by the mean rotation of the two grains. With both
/// rotations, the spring of two grains that rotate together as a rigid body rotates with them.
///
/// The last argument is the mean rotation of the two grains about the normal (radians; ignored in 2D).
template <class T>
inline Shear<2, T> transport(const Shear<2, T>& shear, const Vec<2, T>&, const Vec<2, T>&, const T&) {
  return shear;
}
template <class T>
inline Shear<3, T> transport(const Shear<3, T>& shear, const Vec<3, T>& n0, const Vec<3, T>& n1,
                             const T& twist) {
  using std::cos;
  using std::sin;
  const Vec<3, T> axis = moment<T>(n0, n1);
  const T c = n0.dot(n1);
  // Rodrigues' formula for the rotation n0 -> n1. The denominator 1 + c is zero only for a rotation by 180 degrees in
  // one step.
  const Vec<3, T> turned =
      c * shear + moment<T>(axis, Vec<3, T>(shear)) + axis * (axis.dot(shear) / (T(1) + c));
  // The rotation about the normal does not change the component along the normal.
  const Vec<3, T> along = n1 * n1.dot(turned);
  return along + cos(twist) * (turned - along) + sin(twist) * moment<T>(n1, turned);
}

}  // namespace floc
