#pragma once

#include <cairo.h>

#include "floc/picture/packing_drawing.h"
#include "floc/picture/palette.h"
#include "floc/picture/seen_packing.h"

namespace floc {

/// Returns the box that holds a cell and its spheres, as seen and drawn (length).
Box box_of(const PackingPicture<3>& picture, const View& view);

/// Draws a sphere with light from the upper left, with lengths in points.
void draw_ball(cairo_t* page, const Vec<2>& centre, double radius, const Color& color);

/// A round bar in the same light (points).
struct Bar {
  Vec<2> from = Vec<2>::Zero();
  Vec<2> to = Vec<2>::Zero();
  double width = 1.0;
  /// Lengths by which the ends bulge (points): half the width if round, otherwise half the width times the sine
  /// of the angle of the bar to the page.
  double bulge_from = 0.0, bulge_to = 0.0;
};
void draw_bar(cairo_t* page, const Bar& bar, const Color& color);

/// Draws spheres, tubes and arrows from the farthest to the nearest, after the edges of the cell (and the slab)
/// that lie behind them. Distant parts are paler.
/// @param picture  the one that is seen
/// @param box      of the picture
void draw_seen(cairo_t* page, const SeenPacking& seen, const PackingPicture<3>& picture, const Box& box,
               const Placement& placement);

/// Draws the edges of the cell that do not lie behind, where no sphere hides them.
void draw_front_edges(cairo_t* page, const SeenPacking& seen, const Box& box, const Placement& placement);

/// Draws arrows beside the outline of the cell along its three vectors, with the letters x, y, z.
void draw_axes(cairo_t* page, const SeenPacking& seen, const Box& box, const Placement& placement);

}  // namespace floc
