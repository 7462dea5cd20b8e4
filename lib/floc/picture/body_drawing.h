#pragma once

#include <cairo.h>

#include <functional>

#include "floc/picture/palette.h"
#include "floc/picture/seen_body.h"

namespace floc {

/// Draws a grain with corners, each facet in one colour that tells how far it is turned from the light, which comes
/// from the upper left as for spheres; a capsule is drawn as a round bar.
/// @param on_page  position on the page (points) of a point in the coordinates of the viewer
/// @param points_per_length  scale of the page
void draw_body(cairo_t* page, const SeenBody& body, const std::function<Vec<2>(const Vec<3>&)>& on_page,
               double points_per_length, const Color& color);

}  // namespace floc
