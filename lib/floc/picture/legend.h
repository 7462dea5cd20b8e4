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

/// Text with its left end on the base line at (x, y).
void draw_text(cairo_t* page, double x, double y, const std::string& text);

/// Width of a text (points), the same for every format.
double text_width(const std::string& text);

/// A text broken at its spaces into lines no longer than `width` (points); a word that is longer by itself is
/// broken where it has to be.
std::vector<std::string> wrapped_text(const std::string& text, double width);

/// One thing a legend explains: a sample and text after it.
struct LegendItem {
  double sample_width;  ///< (points)
  /// Draws it from x on, on the line whose middle is at height y.
  std::function<void(cairo_t* page, double x, double y)> draw_sample;
  std::string text;

  double width() const;
  /// Lines of its text in a width of `room` points: beside the sample if its words fit there, otherwise below
  /// it, with the first line empty.
  std::vector<std::string> lines(double room) const;
  void draw(cairo_t* page, double x, double baseline, double room) const;
};

/// A line of that width (points), in 3D a round bar, and its meaning.
template <int Dim>
LegendItem line_item(const Color& color, double width, const std::string& text);

/// The colours of a value, from the most negative to the most positive.
/// @param room  the bar is no longer than this (points)
LegendItem color_bar(const GrainShade& shade, double room);

/// How thick a force of round value is drawn at this scale; no thicker than a line of text.
/// @pre some line has a force
template <int Dim>
LegendItem force_item(const PackingPicture<Dim>& picture, const DrawnScale& scale);

/// What all pictures of a sheet show, explained once: scale bar, kinds of lines, rattlers, arrows, colours,
/// notes.
/// @param bar    longest length of the scale bar, roughly (points)
/// @param width  room for the legend (points)
template <int Dim>
std::vector<LegendItem> legend_of(const std::vector<PackingPicture<Dim>>& pictures, const DrawnScale& scale,
                                  double bar, double width);

/// Height of a legend set in lines no longer than `width` (points).
double legend_height(const std::vector<LegendItem>& items, double width);

void draw_legend(cairo_t* page, const std::vector<LegendItem>& items, double left, double top, double width);

}  // namespace floc
