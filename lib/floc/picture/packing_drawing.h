#pragma once

#include <cairo.h>

#include "floc/picture/drawn_scale.h"
#include "floc/picture/packing_picture.h"
#include "floc/picture/palette.h"

namespace floc {

/// Rectangle around a periodic cell: coordinates of its corners (length). The origin is a corner of the cell.
struct Box {
  Vec<2> low = Vec<2>::Zero();
  Vec<2> high = Vec<2>::Zero();

  Vec<2> size() const { return high - low; }
};
Box box_of(const Cell<2>& cell);

/// Position and scales of a picture on the page. The position is the upper left corner of the rectangle around the cell
/// (points).
struct Placement {
  double left = 0.0, top = 0.0;
  DrawnScale scale;
};

void set_color(cairo_t* page, const Color& color);

Color color_of(LineKind kind);

/// Draws the grains, lines and arrows of a picture, and their periodic copies that reach into the cell. The drawing is
/// clipped at the border of the cell. Grains have no outlines if their mean diameter is below 2.5 points.
void draw_packing(cairo_t* page, const PackingPicture<2>& picture, const Placement& placement);

/// Draws the border of the periodic cell.
void draw_cell(cairo_t* page, const PackingPicture<2>& picture, const Placement& placement);

/// Draws an arrow from one point of the page to another. All lengths are in points.
/// @param width  width of the line of the arrow
/// @param largest_head  largest length of the arrow head
void draw_arrow(cairo_t* page, const Vec<2>& from, const Vec<2>& to, double width, double largest_head);

}  // namespace floc
