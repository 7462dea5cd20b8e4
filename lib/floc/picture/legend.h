#pragma once

#include <cairo.h>

#include <functional>
#include <string>
#include <vector>

#include "floc/picture/drawn_scale.h"
#include "floc/picture/packing_picture.h"
#include "floc/picture/palette.h"

namespace floc {

/// Text of captions and legends, in points.
inline constexpr double kTextSize = 8.0;
inline constexpr double kTextLine = 13.0;  ///< from line to line

void set_font(cairo_t* page);

/// Draws a text with its left end on the base line at (x, y).
void draw_text(cairo_t* page, double x, double y, const std::string& text);

/// Returns the width of a text (points), which is the same for every format.
double text_width(const std::string& text);

/// Breaks a text at its spaces into lines no longer than `width` (points). A word that is longer than a line is
/// broken within.
std::vector<std::string> wrapped_text(const std::string& text, double width);

/// One item of a legend: a sample and the text after it.
struct LegendItem {
  double sample_width;  ///< (points)
  /// Draws the sample from x to the right, with its middle at height y.
  std::function<void(cairo_t* page, double x, double y)> draw_sample;
  std::string text;

  double width() const;
  /// Returns the lines of the text in a width of `room` points: beside the sample if its words fit there,
  /// otherwise below it, with the first line empty.
  std::vector<std::string> lines(double room) const;
  void draw(cairo_t* page, double x, double baseline, double room) const;
};

/// Returns an item with a line of a given width (points), in 3D a round bar, and its meaning.
template <int Dim>
LegendItem line_item(const Color& color, double width, const std::string& text);

/// Returns an item with the colours of a value, from the most negative to the most positive.
/// @param room  largest length of the bar (points)
LegendItem color_bar(const GrainShade& shade, double room);

/// Returns the item that shows the line width of a force of round value at this scale; no thicker than a line
/// of text.
/// @pre some line has a force
template <int Dim>
LegendItem force_item(const PackingPicture<Dim>& picture, const DrawnScale& scale);

/// Returns the legend of a sheet, one item for each element that some picture shows: scale bar, kinds of lines,
/// rattlers, arrows, colours, notes.
/// @param bar    longest length of the scale bar, roughly (points)
/// @param width  room for the legend (points)
template <int Dim>
std::vector<LegendItem> legend_of(const std::vector<PackingPicture<Dim>>& pictures, const DrawnScale& scale,
                                  double bar, double width);

/// Returns the height of a legend set in lines no longer than `width` (points).
double legend_height(const std::vector<LegendItem>& items, double width);

void draw_legend(cairo_t* page, const std::vector<LegendItem>& items, double left, double top, double width);

}  // namespace floc
