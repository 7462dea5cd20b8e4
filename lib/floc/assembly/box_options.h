#pragma once

#include <array>

#include "floc/packing/packing.h"

namespace floc {

/// Boundary of a box across one axis.
enum class BoxSide {
  walls,     ///< two walls under the pressure of the load path
  fixed,     ///< two walls at rest
  periodic,  ///< no walls: periodic, of constant length
};

/// Box in which a packing is assembled, in place of a periodic cell.
struct BoxOptions {
  /// Sides of the box at the start (length); only their proportions count where the solid fraction of the gas
  /// is given.
  Vec<3> sides = Vec<3>::Ones();
  std::array<BoxSide, 3> boundary = {BoxSide::walls, BoxSide::walls, BoxSide::walls};
  double mass = 1.0;              ///< mass of a wall over that of the largest grain
  double friction = 0.0;          ///< friction coefficient of grains on walls
  double adhesion = 0.0;          ///< pull-off force of grains from walls (force)
  double kinetic_pressure = 0.0;  ///< density times mean squared speed of the gas at the start (pressure)
};

/// Contact law between grains and walls: the law of the grains with the friction and the adhesion of the walls.
/// Walls without friction do not resist rolling or twisting either, and walls are dry.
/// @pre the law of the grains has friction if the walls have friction
Law wall_law(const Law& grains, const BoxOptions& box);

/// Makes walls at rest around a packing, at the sides of its cell.
/// @param lowest  position of the lower wall of each axis (length)
template <int Dim>
std::vector<Wall<Dim>> walls_around(const Packing<Dim>& packing, const BoxOptions& box, const Vec<Dim>& lowest);

}  // namespace floc
