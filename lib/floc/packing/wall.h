#pragma once

#include "floc/base/vec.h"

namespace floc {

/// End of the packing along an axis of the cell that is not periodic: a rigid plane with grains on one side of it, or
/// an open end, where the packing ends in free space. A rigid plane moves only along its normal and can be the second
/// body of a contact: the indices of walls follow the indices of the grains, in the order of Packing::walls.
template <int Dim>
struct Wall {
  int axis;               ///< axis normal to the wall, counted from 0
  int side;               ///< +1 if the grains lie below the wall on this axis, -1 if they lie above
  double position;        ///< position of the wall on its axis (length)
  double velocity = 0.0;  ///< velocity of the wall along its axis (length/time)
  double mass = 0.0;      ///< mass of the wall (mass); infinite if forces do not move the wall
  /// Whether this end of the packing is open: there is no plane, `position` is only an outer limit of the grains, and
  /// grains do not touch it.
  bool open = false;

  /// Returns the unit vector normal to the wall that points from the grains to the wall.
  Vec<Dim> normal() const { return side * Vec<Dim>::Unit(axis); }

  bool operator==(const Wall&) const = default;
};

}  // namespace floc
