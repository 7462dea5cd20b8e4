#pragma once

#include <vector>

#include "floc/shape/shape.h"

namespace floc {

/// Flat facets that approximate the surface of a convex shape in 3D.
struct Facets {
  struct Facet {
    std::vector<int> corners;  ///< indices in `points`, counter-clockwise as seen from outside
    Vec<3> normal;             ///< outward unit normal
  };
  std::vector<Vec<3>> points;
  std::vector<Facet> facets;
};

/// Returns the facets of a polyhedron. The edges and corners of a rounded polyhedron are parts of cylinders and
/// spheres. Flat bevels replace them: the facets are the facets of the convex hull of the flat parts of the surface.
/// @pre the core of the shape (the shape without its rounding) has faces
Facets facets_of(const Shape<3>& shape);

}  // namespace floc
