#pragma once

#include <array>

#include "floc/packing/packing.h"

namespace floc {

/// Boundary of a box across one axis.
enum class BoxSide {
  walls,     ///< two walls that move under the pressure of the load path
  fixed,     ///< two walls that do not move
  periodic,  ///< no walls: a periodic boundary; the length of the box along this axis is constant
};

/// Box with walls in which a packing is assembled, in place of a periodic cell.
struct BoxOptions {
  /// Sides of the box at the start (length). If the solid fraction of the gas is given, only their proportions
  /// matter.
  Vec<3> sides = Vec<3>::Ones();
  std::array<BoxSide, 3> boundary = {BoxSide::walls, BoxSide::walls, BoxSide::walls};
  double mass = 1.0;              ///< mass of a wall divided by the mass of the largest grain
  double friction = 0.0;          ///< friction coefficient between grains and walls
  double adhesion = 0.0;          ///< pull-off force between grains and walls (force)
  double kinetic_pressure = 0.0;  ///< density times mean squared speed of the gas at the start (pressure)
};

/// Returns the contact law between grains and walls: the law of the grains with the friction and the adhesion
/// of the walls. Walls without friction do not resist rolling or twisting either, and there are no liquid
/// bridges to walls.
/// @pre the law of the grains has friction if the walls have friction
Law wall_law(const Law& grains, const BoxOptions& box);

/// Returns walls at rest around a packing, as far apart as the sides of its cell are long.
/// @param lowest  position of the lower wall of each axis (length)
template <int Dim>
std::vector<Wall<Dim>> walls_around(const Packing<Dim>& packing, const BoxOptions& box, const Vec<Dim>& lowest);

}  // namespace floc
