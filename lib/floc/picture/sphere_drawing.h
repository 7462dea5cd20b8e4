#pragma once

#include <cairo.h>

#include "floc/picture/packing_drawing.h"
#include "floc/picture/palette.h"
#include "floc/picture/seen_packing.h"

namespace floc {

/// Returns the rectangle (length) around a cell and its grains with their drawn radii, as seen from the viewpoint.
Box box_of(const PackingPicture<3>& picture, const View& view);

/// Draws a sphere that is lit from the upper left. Centre and radius are in points.
void draw_ball(cairo_t* page, const Vec<2>& centre, double radius, const Color& color);

/// A round bar that is lit from the upper left, as the spheres are. Lengths are in points.
struct Bar {
  Vec<2> from = Vec<2>::Zero();
  Vec<2> to = Vec<2>::Zero();
  double width = 1.0;
  /// Lengths by which the outline of the bar extends beyond `from` and `to` (points). At a round end, this is half the
  /// width; at a flat end, half the width times the sine of the angle between the bar and the page.
  double bulge_from = 0.0, bulge_to = 0.0;
};
void draw_bar(cairo_t* page, const Bar& bar, const Color& color);

/// Draws, in this order: the edges of the cell that lie behind the grains, the edges of the slab if only a slab of the
/// cell is shown, and the grains, tubes and arrows from the farthest to the nearest. Parts farther from the eye are
/// paler.
/// @param picture  picture from which `seen` was computed
/// @param box  rectangle around the picture, from box_of()
void draw_seen(cairo_t* page, const SeenPacking& seen, const PackingPicture<3>& picture, const Box& box,
               const Placement& placement);

/// Draws the edges of the cell that are not at its back, except where grains hide them.
void draw_front_edges(cairo_t* page, const SeenPacking& seen, const Box& box, const Placement& placement);

/// Draws short arrows along the three cell vectors, outside the outline of the cell, with the letters x, y and z.
void draw_axes(cairo_t* page, const SeenPacking& seen, const Box& box, const Placement& placement);

}  // namespace floc
