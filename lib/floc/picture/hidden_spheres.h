#pragma once

#include <vector>

#include "floc/picture/seen_packing.h"

namespace floc {

/// Removes spheres that are completely hidden behind other spheres, and returns the remaining spheres: all visible
/// spheres, and some hidden spheres. For this test, the picture is divided into square tiles, whose width is an eighth
/// of the smallest radius. A tile counts as covered only if a single sphere covers all of it.
std::vector<SeenSphere> without_hidden(std::vector<SeenSphere> spheres);

/// Extent of a convex body in a picture.
struct BodyExtent {
  Vec<3> centre = Vec<3>::Zero();  ///< centre in the coordinates of a Camera (length)
  double inner = 0.0;              ///< radius of a sphere about the centre that lies inside the body
  double outer = 0.0;              ///< radius of a sphere about the centre that contains the body
};

/// Returns for each body whether the body is completely hidden behind other bodies. No visible body counts as hidden. A
/// hidden body may count as visible, because only the inner sphere of each body is taken to hide other bodies, and
/// because tiles are used as in without_hidden().
std::vector<bool> hidden_bodies(const std::vector<BodyExtent>& bodies);

}  // namespace floc
