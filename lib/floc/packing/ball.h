#pragma once

#include <numbers>

namespace floc {

/// Shape of a grain: a disk in 2D, a sphere in 3D. Its members give the quantities that depend on the shape
/// alone.
template <int Dim>
struct Ball {
  double radius;  ///< (length)

  /// Area of a disk, volume of a sphere (length^Dim).
  double volume() const { return std::numbers::pi * radius * radius * (Dim == 2 ? 1.0 : 4.0 / 3.0 * radius); }
  /// Moment of inertia about the centre: m d^2/8 of a disk, m d^2/10 of a sphere (mass * length^2).
  double inertia(double mass) const { return mass * radius * radius * (Dim == 2 ? 0.5 : 0.4); }
};

/// Lever arm of the first ball over the branch between two balls, Ri/(Ri + Rj): the contact point divides the
/// branch in proportion to the radii (docs/physics.md, "Kinematics of a contact"). A wall has radius 0, so that
/// the result is 1 and the arm is the whole branch.
inline double lever_share(double radius_i, double radius_j) {
  return radius_i / (radius_i + radius_j);
}

}  // namespace floc
