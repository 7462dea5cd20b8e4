#pragma once

#include <cairo.h>

#include <functional>

#include "floc/picture/palette.h"
#include "floc/picture/seen_body.h"

namespace floc {

/// Draws a grain with corners. Each facet has one colour, which depends on the angle between its normal and the
/// light. The light comes from the upper left, as for spheres. A capsule is drawn as a round bar.
/// @param on_page  function that maps a point in the coordinates of the viewer to its position on the page (points)
/// @param points_per_length  scale of the page
void draw_body(cairo_t* page, const SeenBody& body, const std::function<Vec<2>(const Vec<3>&)>& on_page,
               double points_per_length, const Color& color);

}  // namespace floc
