#pragma once

#include <array>

#include "floc/packing/packing.h"

namespace floc {

/// Kind of boundary at the two faces of a box that are perpendicular to one axis.
enum class BoxSide {
  walls,     ///< two walls that move under the imposed pressure
  fixed,     ///< two walls that do not move
  periodic,  ///< no walls: a periodic boundary; the length of the box along this axis is constant
  floor,     ///< a wall that does not move at the lower end, and free space above the grains
  /// a wall that does not move at the lower end, and a wall that moves under the imposed pressure at the upper end
  lid,
};

/// Box with walls in which grains are packed. It replaces the periodic cell.
struct BoxOptions {
  /// Sides of the box at the start (length). If the solid fraction of the gas is given, the solid fraction determines
  /// the size of the box, and only the ratios of these numbers matter.
  Vec<3> sides = Vec<3>::Ones();
  std::array<BoxSide, 3> boundary = {BoxSide::walls, BoxSide::walls, BoxSide::walls};
  Vec<3> gravity = Vec<3>::Zero();  ///< acceleration due to gravity (length/time^2)
  double mass = 1.0;                ///< mass of a wall divided by the mass of the largest grain
  double friction = 0.0;            ///< friction coefficient between grains and walls
  double adhesion = 0.0;            ///< pull-off force between grains and walls (force)
  /// kinetic pressure of the gas at the start: its mass density times the mean squared speed of the grains (pressure)
  double kinetic_pressure = 0.0;
};

/// Returns the contact law between grains and walls: the law between two grains, but with the friction coefficient and
/// the pull-off force of the walls. Walls without friction do not resist rolling or twisting. There are no liquid
/// bridges to walls.
/// @param grains  contact law between two grains
/// @pre if the walls have friction, the law between two grains has friction, too, or it is the law of rigid contacts
Law wall_law(const Law& grains, const BoxOptions& box);

/// Returns whether a wall moves under the imposed pressure at this kind of boundary.
inline bool moves(BoxSide side) {
  return side == BoxSide::walls || side == BoxSide::lid;
}
/// Returns whether any wall of a box moves under the imposed pressure.
/// @param dimension  number of axes
bool any_wall_moves(const BoxOptions& box, int dimension);

/// Returns walls at rest around a packing. The distance between opposite walls is the side of the cell of the packing.
/// @param lowest  for each axis, the position of the wall at the lower end of the axis (length)
template <int Dim>
std::vector<Wall<Dim>> walls_around(const Packing<Dim>& packing, const BoxOptions& box, const Vec<Dim>& lowest);

}  // namespace floc
