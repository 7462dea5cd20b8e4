#pragma once

#include <cairo.h>

#include "floc/picture/drawn_scale.h"
#include "floc/picture/packing_picture.h"
#include "floc/picture/palette.h"

namespace floc {

/// Rectangle around a periodic cell, in coordinates in which one corner of the cell is the origin (length).
struct Box {
  Vec<2> low = Vec<2>::Zero();
  Vec<2> high = Vec<2>::Zero();

  Vec<2> size() const { return high - low; }
};
Box box_of(const Cell<2>& cell);

/// Position of a picture on the page (points): the upper left corner of the rectangle around its cell.
struct Placement {
  double left = 0.0, top = 0.0;
  DrawnScale scale;
};

void set_color(cairo_t* page, const Color& color);

Color color_of(LineKind kind);

/// Draws the grains, lines and arrows of a picture, clipped at the border of the cell. Periodic copies of grains, lines
/// and arrows that reach into the cell are drawn too. Outlines of grains are left out if the mean diameter is below 2.5
/// points.
void draw_packing(cairo_t* page, const PackingPicture<2>& picture, const Placement& placement);

/// Draws the border of the periodic cell.
void draw_cell(cairo_t* page, const PackingPicture<2>& picture, const Placement& placement);

/// Draws an arrow between two points of the page, whose head is not longer than `largest_head` (points).
void draw_arrow(cairo_t* page, const Vec<2>& from, const Vec<2>& to, double width, double largest_head);

}  // namespace floc
