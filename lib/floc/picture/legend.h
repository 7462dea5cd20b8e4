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

/// Draws a text. The left end of its base line is at (x, y), in points.
void draw_text(cairo_t* page, double x, double y, const std::string& text);

/// Returns the width of a text in the font of legends (points). The width does not depend on the picture format.
double text_width(const std::string& text);

/// Breaks a text at its spaces into lines that are at most `width` wide (points). A wider word is broken too.
std::vector<std::string> wrapped_text(const std::string& text, double width);

/// One item of a legend: a graphical sample and the text to the right of it.
struct LegendItem {
  double sample_width;  ///< width of the sample (points)
  /// Draws the sample with its left end at x and its middle at the height y (points).
  std::function<void(cairo_t* page, double x, double y)> draw_sample;
  std::string text;

  double width() const;
  /// Returns the text, broken into lines. The sample and the text together are at most `room` wide (points). The text
  /// is to the right of the sample if there is room for the widest word. Otherwise the text is below the sample, and
  /// the first line returned is empty.
  std::vector<std::string> lines(double room) const;
  void draw(cairo_t* page, double x, double baseline, double room) const;
};

/// Returns a legend item whose sample is a line or, in 3D, a round bar.
/// @param width  width of the line (points)
/// @param text  meaning of the line
template <int Dim>
LegendItem line_item(const Color& color, double width, const std::string& text);

/// Returns a legend item with a colour bar for the values of grains, from the most negative to the most positive value.
/// @param room  largest length of the bar (points)
LegendItem color_bar(const GrainShade& shade, double room);

/// Returns the legend item of the force scale: the line width for one round value of the contact force. The value is
/// chosen so that the line is at most as thick as the text is high.
/// @pre at least one line of the picture has a force > 0
template <int Dim>
LegendItem force_item(const PackingPicture<Dim>& picture, const DrawnScale& scale);

/// Returns the legend of a page of pictures. The legend has a scale bar, and one item for each kind of line, for
/// rattlers, arrows, colours and notes, if they appear in at least one of the pictures.
/// @param bar  largest length of the scale bar (points)
/// @param width  width of the legend (points)
template <int Dim>
std::vector<LegendItem> legend_of(const std::vector<PackingPicture<Dim>>& pictures, const DrawnScale& scale,
                                  double bar, double width);

/// Returns the height (points) of a legend whose lines are at most `width` wide (points).
double legend_height(const std::vector<LegendItem>& items, double width);

void draw_legend(cairo_t* page, const std::vector<LegendItem>& items, double left, double top, double width);

}  // namespace floc
