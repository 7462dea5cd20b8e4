#pragma once

#include "floc/base/vec.h"

namespace floc {

/// A rigid plane across an axis of the cell, with grains on one side of it. It moves along its normal alone.
/// Walls are bodies: their identifiers follow those of the grains, in the order of Packing::walls.
template <int Dim>
struct Wall {
  int axis;               ///< of its normal
  int side;               ///< +1: grains lie below it on the axis; -1: above
  double position;        ///< on the axis (length)
  double velocity = 0.0;  ///< along the axis (length/time)
  double mass = 0.0;      ///< (mass)

  /// Unit vector from the grains to the wall.
  Vec<Dim> normal() const { return side * Vec<Dim>::Unit(axis); }

  bool operator==(const Wall&) const = default;
};

}  // namespace floc
