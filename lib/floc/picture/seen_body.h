#pragma once

#include <utility>
#include <vector>

#include "floc/picture/facets.h"
#include "floc/picture/view.h"
#include "floc/shape/placed_shape.h"

namespace floc {

// Points and normals are in the coordinates of a Camera: x to the right, y upwards, z towards the eye (length).

/// A grain with corners or a capsule, in the coordinates of the viewer.
struct SeenBody {
  Vec<3> centre = Vec<3>::Zero();
  double radius = 0.0;  ///< radius of a sphere about the centre that contains the body as drawn
  int grain = 0;
  std::vector<Vec<3>> points;         ///< corners of the facets; for a capsule, the ends of its axis
  std::vector<Facets::Facet> facets;  ///< facets that face the eye; empty for a capsule
  double rounding = 0.0;              ///< radius of rounding; for a capsule, its radius
};

/// Returns a body in the coordinates of the viewer.
/// @param facets  facets of the shape, from facets_of(); not used for a capsule
/// @pre the shape is not a sphere
SeenBody seen_body(const PlacedShape<3>& placed, const Facets& facets, const Camera& camera, int grain);

/// Adds the parts of a line segment that a body hides or contains, as fractions of the length of the segment in [0, 1].
void add_hidden_parts(const Vec<3>& from, const Vec<3>& to, const SeenBody& body,
                      std::vector<std::pair<double, double>>& hidden);

/// Returns the distance (length) from the centre of a shape to its surface, as if its edges and corners were sharp.
/// @param direction  unit vector in space
double distance_to_surface(const PlacedShape<3>& placed, const Vec<3>& direction);

}  // namespace floc
