#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/assembly/shape_options.h"

namespace floc {

/// Shapes of the grains of a scene, drawn at random or read from a file.
template <int Dim>
struct DrawnShapes {
  std::vector<Shape<Dim>> shapes;    ///< at least one shape; each has the diameter 1
  std::vector<std::string> remarks;  ///< remarks about the content of the file of the shapes
};

/// Draws or reads the shapes of the grains of a scene.
/// @param seed  seed of the run; with equal options and equal seeds, the shapes are equal
/// @throws InputError if an option is out of its range, if a kind of shape does not exist in this dimension, or if the
/// file of the shapes cannot be read or has changed since the scene was read
template <int Dim>
DrawnShapes<Dim> draw_shapes(const ShapeOptions& options, std::uint64_t seed);

}  // namespace floc
