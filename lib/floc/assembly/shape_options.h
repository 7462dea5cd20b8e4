#pragma once

#include <string>
#include <variant>
#include <vector>

#include "floc/shape/generators.h"

namespace floc {

/// Shape of regular polygons (2D).
struct PolygonOptions {
  int sides = 5;
};
/// Shape of rectangles or cuboids. The member `sides` has one number for each dimension; only the ratios of the numbers
/// matter.
struct BoxShapeOptions {
  std::vector<double> sides;
};
/// Shape of capsules that are `aspect` times as long as they are thick.
struct CapsuleOptions {
  double aspect = 2.0;
};
/// Shapes that are read from a file.
struct FileShapeOptions {
  std::string file;    ///< path of the file
  int vertices = 0;    ///< number of vertices to which each shape is reduced; 0 keeps all
  std::string sha256;  ///< SHA-256 checksum that the file must have; empty if the content is not checked
};

/// Shapes of the grains of a scene (table grains.shape). All shapes have the diameter 1. The shape of each grain is
/// scaled to the diameter of the grain.
struct ShapeOptions {
  std::variant<PolygonOptions, BoxShapeOptions, HullOptions, CutOptions, VoronoiOptions, CapsuleOptions,
               FileShapeOptions>
      kind;
  double rounding = 0.0;  ///< radius of rounding divided by the diameter, from 0 to 0.45
  int count = 60;         ///< number of different shapes that are drawn at random
};

}  // namespace floc
