#pragma once

#include <array>

#include "floc/packing/packing.h"

namespace floc {

/// What bounds a box across one axis.
enum class BoxSide {
  walls,     ///< two walls under the pressure of the load path
  fixed,     ///< two walls at rest
  periodic,  ///< no walls: periodic, of constant length
};

/// A box that grains are put together in, in place of a periodic cell.
struct BoxOptions {
  /// Sides of the box at the start (length); mere proportions where the solid fraction of the gas is given.
  Vec<3> sides = Vec<3>::Ones();
  std::array<BoxSide, 3> boundary = {BoxSide::walls, BoxSide::walls, BoxSide::walls};
  double mass = 1.0;              ///< of a wall, in masses of the largest grain
  double friction = 0.0;          ///< coefficient of grains on walls
  double adhesion = 0.0;          ///< pull-off force of grains from walls (force)
  double kinetic_pressure = 0.0;  ///< of the gas at the start, density times squared speed, unit of pressure
};

/// The law between grains and walls: that of the grains, with the friction and the adhesion of the walls. Walls
/// without friction do not resist rolling or twisting either.
/// @pre the grains have friction if the walls have some
Law wall_law(const Law& grains, const BoxOptions& box);

/// Walls around a packing, at the sides of its cell, at rest.
/// @param lowest  position of the lower wall of each axis (length)
template <int Dim>
std::vector<Wall<Dim>> walls_around(const Packing<Dim>& packing, const BoxOptions& box, const Vec<Dim>& lowest);

}  // namespace floc
