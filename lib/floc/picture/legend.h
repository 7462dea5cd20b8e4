#pragma once

#include <cairo.h>

#include <functional>
#include <string>
#include <vector>

#include "floc/picture/drawn_scale.h"
#include "floc/picture/packing_picture.h"
#include "floc/picture/palette.h"

namespace floc {

/// Size of the text in captions and legends (points).
inline constexpr double kTextSize = 8.0;
/// Distance between the base lines of successive lines of text (points).
inline constexpr double kTextLine = 13.0;

void set_font(cairo_t* page);

/// Draws a text whose left end on the base line is at (x, y), in points.
void draw_text(cairo_t* page, double x, double y, const std::string& text);

/// Returns the width of a text (points). It does not depend on the format of the picture.
double text_width(const std::string& text);

/// Breaks a text at its spaces into lines not wider than `width` (points). A word that is wider than a line is broken
/// too.
std::vector<std::string> wrapped_text(const std::string& text, double width);

/// One item of a legend: a graphical sample and the text to the right of it.
struct LegendItem {
  double sample_width;  ///< width of the sample (points)
  /// Draws the sample to the right of x, with its middle at height y (points).
  std::function<void(cairo_t* page, double x, double y)> draw_sample;
  std::string text;

  double width() const;
  /// Returns the lines into which the text is broken if the item is at most `room` wide (points). The text is to the
  /// right of the sample if each of its words fits there; otherwise it is below the sample, and the first line returned
  /// is empty.
  std::vector<std::string> lines(double room) const;
  void draw(cairo_t* page, double x, double baseline, double room) const;
};

/// Returns a legend item whose sample is a line (in 3D a round bar) of a given width (points), with a text that
/// explains the line.
template <int Dim>
LegendItem line_item(const Color& color, double width, const std::string& text);

/// Returns a legend item with a colour bar for the values of grains, from the most negative to the most positive value.
/// @param room  largest length of the bar (points)
LegendItem color_bar(const GrainShade& shade, double room);

/// Returns a legend item that shows how wide the line of a contact force is drawn, for a round value of the force. This
/// value is chosen so that the line is not thicker than the text is high.
/// @pre some line of the picture has a force > 0
template <int Dim>
LegendItem force_item(const PackingPicture<Dim>& picture, const DrawnScale& scale);

/// Returns the legend of a page with pictures, with an item for each element that some picture shows: scale bar, kinds
/// of lines, rattlers, arrows, colours, notes.
/// @param bar  approximate largest length of the scale bar (points)
/// @param width  width of the legend (points)
template <int Dim>
std::vector<LegendItem> legend_of(const std::vector<PackingPicture<Dim>>& pictures, const DrawnScale& scale,
                                  double bar, double width);

/// Returns the height of a legend whose lines are not wider than `width` (points).
double legend_height(const std::vector<LegendItem>& items, double width);

void draw_legend(cairo_t* page, const std::vector<LegendItem>& items, double left, double top, double width);

}  // namespace floc
