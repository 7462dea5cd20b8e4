#pragma once

#include <cairo.h>

#include <functional>

#include "floc/picture/palette.h"
#include "floc/picture/seen_body.h"

namespace floc {

/// Draws a grain with corners, or a capsule as a round bar. The light comes from the upper left, as for spheres. Each
/// facet has one shade, which depends on the angle between the normal of the facet and the light.
/// @param on_page  function that maps a point in the coordinates of the viewer to its position on the page (points)
/// @param points_per_length  scale of the picture (points per unit of length)
void draw_body(cairo_t* page, const SeenBody& body, const std::function<Vec<2>(const Vec<3>&)>& on_page,
               double points_per_length, const Color& color);

}  // namespace floc
