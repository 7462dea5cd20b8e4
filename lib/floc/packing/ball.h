#pragma once

#include <numbers>

namespace floc {

/// The shape of a grain: a disk in 2D, a sphere in 3D. What depends on the shape of grains alone is asked here.
template <int Dim>
struct Ball {
  double radius;  ///< (length)

  /// Area of a disk, volume of a sphere (length^Dim).
  double volume() const { return std::numbers::pi * radius * radius * (Dim == 2 ? 1.0 : 4.0 / 3.0 * radius); }
  /// Moment of inertia about the centre: m d^2/8 of a disk, m d^2/10 of a sphere (mass * length^2).
  double inertia(double mass) const { return mass * radius * radius * (Dim == 2 ? 0.5 : 0.4); }
};

/// Share of the branch between two balls that is the lever arm of the first, Ri/(Ri + Rj): the contact point
/// divides the branch as the radii do (docs/physics.md, "Kinematics of a contact"). Against a wall, whose radius
/// is 0 at the foot of the grain's centre, it is all of it.
inline double lever_share(double radius_i, double radius_j) {
  return radius_i / (radius_i + radius_j);
}

}  // namespace floc
