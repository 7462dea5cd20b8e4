#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Rigid plane across an axis of the cell, with grains on one side of it. It moves only along its normal. A
/// wall is a body of contacts: the indices of walls follow those of the grains, in the order of Packing::walls.
template <int Dim>
struct Wall {
  int axis;               ///< axis of its normal, from 0
  int side;               ///< +1: grains lie below the wall on the axis; -1: above
  double position;        ///< position on the axis (length)
  double velocity = 0.0;  ///< velocity along the axis (length/time)
  double mass = 0.0;      ///< infinite for a wall that does not follow forces (mass)

  /// Unit vector from the grains to the wall.
  Vec<Dim> normal() const { return side * Vec<Dim>::Unit(axis); }

  bool operator==(const Wall&) const = default;
};

}  // namespace floc
