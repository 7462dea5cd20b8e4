#pragma once

#include <vector>

#include "floc/shape/placed_shape.h"

namespace floc {

/// Corner of the outline of a shape in 2D: a counter-clockwise arc of a circle.
struct OutlineCorner {
  Vec<2> centre =
      Vec<2>::Zero();  ///< centre of the circle: a vertex of the core (the shape without its rounding)
  double begin = 0.0,
         end = 0.0;  ///< angles at which the arc begins and ends (radians), begin < end <= begin + 2 pi
};

/// Outline of a shape in 2D: its corners in counter-clockwise order, each connected to the next by a straight side.
struct Outline {
  std::vector<OutlineCorner> corners;
  double radius = 0.0;  ///< radius of all arcs; 0 for sharp corners
};

/// Returns the outline of a polygon, with or without rounding, or of a capsule. @pre the shape is not a disk
Outline outline_of(const PlacedShape<2>& placed);

}  // namespace floc
