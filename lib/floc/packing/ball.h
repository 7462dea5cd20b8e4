#pragma once

#include <numbers>

namespace floc {

/// A round grain: a disk in 2D, a sphere in 3D.
template <int Dim>
struct Ball {
  double radius;  ///< radius of the grain (length)

  /// Returns the area of a disk or the volume of a sphere (length^Dim).
  double volume() const { return std::numbers::pi * radius * radius * (Dim == 2 ? 1.0 : 4.0 / 3.0 * radius); }
  /// Returns the moment of inertia about the centre: m d^2/8 of a disk, m d^2/10 of a sphere, with the mass m
  /// and the diameter d (mass * length^2).
  double inertia(double mass) const { return mass * radius * radius * (Dim == 2 ? 0.5 : 0.4); }
};

/// Returns Ri/(Ri + Rj) for two touching balls of radii Ri and Rj: the lever arm of the first ball, divided by the
/// distance between the centres. The contact point divides the line between the centres in proportion to the radii
/// (docs/physics.md, "Kinematics of a contact"). If the second body is a wall, it counts as a ball of radius 0, and the
/// result is 1: the lever arm ends at the wall.
inline double lever_share(double radius_i, double radius_j) {
  return radius_i / (radius_i + radius_j);
}

}  // namespace floc
