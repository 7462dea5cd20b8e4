#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/assembly/shape_options.h"

namespace floc {

/// Shapes of the grains of a scene.
template <int Dim>
struct DrawnShapes {
  std::vector<Shape<Dim>> shapes;    ///< at least one shape; each has the diameter 1
  std::vector<std::string> remarks;  ///< remarks about the content of the file of the shapes
};

/// Draws or reads the shapes of the grains of a scene.
/// @param seed  seed of the run; equal options with equal seeds give equal shapes
/// @throws InputError if an option is out of its range, if a kind of shape does not exist in this dimension, if the
/// file of the shapes cannot be read, or if it has changed since the scene was read
template <int Dim>
DrawnShapes<Dim> draw_shapes(const ShapeOptions& options, std::uint64_t seed);

}  // namespace floc
