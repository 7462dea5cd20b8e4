#include "floc/picture/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "floc/packing/grain_sizes.h"
#include "floc/picture/packing_drawing.h"
#include "floc/picture/palette.h"
#include "floc/picture/sphere_drawing.h"

namespace floc {
namespace {

constexpr double kBetween = 12.0;  ///< distance between two items of the legend (points)
constexpr double kAfterSample = 4.0;
/// Largest width (points) of the line that shows the force scale in the legend. A wider line would cover text.
constexpr double kThickest = 8.0;

template <int Dim>
std::string name_of(LineKind kind, const PackingPicture<Dim>& picture) {
  switch (kind) {
    case LineKind::background:
      return picture.background_name;
    case LineKind::zero:
      return "zero";
    case LineKind::distant:
      return picture.distant_name;
    case LineKind::tension:
      return picture.tension_name;
    case LineKind::compression:
      return picture.compression_name;
    case LineKind::lost:
      return "contact lost";
    case LineKind::gained:
      return "contact gained";
  }
  return "";
}

LegendItem scale_bar(double diameter, double points_per_length, double longest) {
  const double length = round_number_below(longest / (diameter * points_per_length));
  const double points = length * diameter * points_per_length;
  return {points,
          [points](cairo_t* page, double x, double y) {
            set_color(page, palette::kText);
            cairo_set_line_width(page, 1.0);
            cairo_set_line_cap(page, CAIRO_LINE_CAP_BUTT);
            for (const double end : {x, x + points}) {
              cairo_move_to(page, end, y - 2.5);
              cairo_line_to(page, end, y + 2.5);
            }
            cairo_move_to(page, x, y);
            cairo_line_to(page, x + points, y);
            cairo_stroke(page);
          },
          short_number(length) + " a (largest diameter)"};
}

template <int Dim>
LegendItem grain_item(const Color& fill, const std::string& text) {
  return {8.0,
          [fill](cairo_t* page, double x, double y) {
            if constexpr (Dim == 3) return draw_ball(page, {x + 4.0, y}, 3.7, fill);
            cairo_new_sub_path(page);
            cairo_arc(page, x + 4.0, y, 3.7, 0.0, 6.2831853071795862);
            set_color(page, fill);
            cairo_fill_preserve(page);
            set_color(page, palette::kOutline);
            cairo_set_line_width(page, 0.6);
            cairo_stroke(page);
          },
          text};
}

template <int Dim>
LegendItem arrow_item(const PackingPicture<Dim>& picture, const DrawnScale& scale) {
  const double a = largest_diameter(picture.radius);
  const double length = round_number_below(2.0 * rms_displacement(picture) / a);
  const double points = length * a * scale.points_per_displacement;
  return {points,
          [points](cairo_t* page, double x, double y) {
            set_color(page, palette::kArrow);
            draw_arrow(page, {x, y}, {x + points, y}, 0.8, 4.5);
          },
          short_number(length) + " a displacement"};
}

LegendItem text_item(const std::string& text) {
  return {-kAfterSample, [](cairo_t*, double, double) {}, text};
}

/// Distributes the items of a legend over lines of text, and calls `place(item, x, line)` for each item: x is the
/// distance of the item from the left end of the line (points), and `line` is the index of the line. Each line is
/// filled from the left. An item that is wider than a line takes as many lines as its text needs. @return number of
/// lines of the legend
template <class Place>
int flow(const std::vector<LegendItem>& items, double width, Place&& place) {
  double x = 0.0;
  int line = 0, n_lines = 0;
  for (const LegendItem& item : items) {
    if (x > 0.0 && x + item.width() > width) x = 0.0, ++line;
    place(item, x, line);
    const auto n = static_cast<int>(item.lines(width).size());
    n_lines = line + n;
    x += item.width() + kBetween;
    if (n > 1) x = 0.0, line += n;
  }
  return n_lines;
}

/// Returns the number of bytes of the longest beginning of a text that fits into `width` (points). The beginning has at
/// least one letter, even if this letter does not fit. A letter of several bytes (UTF-8) is never divided.
std::size_t end_of_fitting(const std::string& text, double width) {
  std::size_t end = 0;
  do {
    std::size_t next = end + 1;
    while (next < text.size() && (static_cast<unsigned char>(text[next]) & 0xC0U) == 0x80U) ++next;
    if (end > 0 && text_width(text.substr(0, next)) > width) break;
    end = next;
  } while (end < text.size());
  return end;
}

}  // namespace

LegendItem color_bar(const GrainShade& shade, double room) {
  const double width = std::min(90.0, room);
  return {
      width,
      [width](cairo_t* page, double x, double y) {
        cairo_pattern_t* gradient = cairo_pattern_create_linear(x, 0.0, x + width, 0.0);
        const auto n = static_cast<int>(palette::kDiverging.size());
        for (int k = 0; k < n; ++k) {
          const Color& c = palette::kDiverging[static_cast<std::size_t>(k)];
          cairo_pattern_add_color_stop_rgb(gradient, static_cast<double>(k) / (n - 1), c.red, c.green, c.blue);
        }
        cairo_rectangle(page, x, y - 4.0, width, 8.0);
        cairo_set_source(page, gradient);
        cairo_fill_preserve(page);
        cairo_pattern_destroy(gradient);
        set_color(page, palette::kOutline);
        cairo_set_line_width(page, 0.5);
        cairo_stroke(page);
      },
      fmt::format("{} from −{} to {}", shade.name, short_number(shade.largest), short_number(shade.largest))};
}

void set_font(cairo_t* page) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(page, options);
  cairo_font_options_destroy(options);
  cairo_select_font_face(page, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(page, kTextSize);
}

void draw_text(cairo_t* page, double x, double y, const std::string& text) {
  set_color(page, palette::kText);
  cairo_move_to(page, x, y);
  cairo_show_text(page, text.c_str());
}

double text_width(const std::string& text) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  cairo_t* context = cairo_create(surface);
  set_font(context);
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  cairo_destroy(context);
  cairo_surface_destroy(surface);
  return extents.x_advance;
}

std::vector<std::string> wrapped_text(const std::string& text, double width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.empty() && text_width(lines.back() + " " + word) <= width) {
      lines.back() += " " + word;
      continue;
    }
    while (text_width(word) > width) {
      const std::size_t end = end_of_fitting(word, width);
      if (end == word.size()) break;
      lines.push_back(word.substr(0, end));
      word.erase(0, end);
    }
    lines.push_back(word);
  }
  return lines;
}

double LegendItem::width() const {
  return sample_width + kAfterSample + text_width(text);
}

std::vector<std::string> LegendItem::lines(double room) const {
  if (width() <= room) return {text};
  const double beside = room - sample_width - kAfterSample;
  std::istringstream words(text);
  bool fits = true;
  for (std::string word; words >> word;) fits = fits && text_width(word) <= beside;
  if (fits) return wrapped_text(text, beside);
  std::vector<std::string> below = wrapped_text(text, room);
  if (sample_width > 0.0) below.insert(below.begin(), "");
  return below;
}

void LegendItem::draw(cairo_t* page, double x, double baseline, double room) const {
  draw_sample(page, x, baseline - 0.36 * kTextSize);
  const std::vector<std::string> set = lines(room);
  const bool below = set.front().empty() || (set.size() > 1 && sample_width <= 0.0);
  for (const std::string& line : set) {
    draw_text(page, below ? x : x + sample_width + kAfterSample, baseline, line);
    baseline += kTextLine;
  }
}

template <int Dim>
LegendItem line_item(const Color& color, double width, const std::string& text) {
  constexpr double kLength = 16.0;
  return {kLength,
          [color, width](cairo_t* page, double x, double y) {
            if constexpr (Dim == 3) return draw_bar(page, {{x, y}, {x + kLength, y}, width, 0.0, 0.0}, color);
            set_color(page, color);
            cairo_set_line_width(page, width);
            cairo_set_line_cap(page, CAIRO_LINE_CAP_BUTT);
            cairo_move_to(page, x, y);
            cairo_line_to(page, x + kLength, y);
            cairo_stroke(page);
          },
          text};
}

template <int Dim>
LegendItem force_item(const PackingPicture<Dim>& picture, const DrawnScale& scale) {
  const double force =
      round_number_below(std::min(2.0 * rms_force(picture), kThickest / scale.points_per_force));
  return line_item<Dim>(Dim == 2 ? palette::kText : palette::kOutline, force * scale.points_per_force,
                        "|" + picture.force_symbol + "| = " + short_number(force) + " " + picture.force_unit);
}

template <int Dim>
std::vector<LegendItem> legend_of(const std::vector<PackingPicture<Dim>>& pictures, const DrawnScale& scale,
                                  double bar, double width) {
  const PackingPicture<Dim>& first = pictures.front();
  std::vector<LegendItem> items = {scale_bar(largest_diameter(first.radius), scale.points_per_length, bar)};
  std::set<LineKind> kinds;
  bool rattlers = false;
  for (const PackingPicture<Dim>& picture : pictures) {
    for (const ContactLine<Dim>& line : picture.lines) kinds.insert(line.kind);
    rattlers =
        rattlers || std::find(picture.rattler.begin(), picture.rattler.end(), true) != picture.rattler.end();
  }
  for (const LineKind kind : std::vector<LineKind>(kinds.rbegin(), kinds.rend()))
    items.push_back(line_item<Dim>(color_of(kind), kind == LineKind::zero ? 0.8 : 2.0, name_of(kind, first)));
  if (rattlers) items.push_back(grain_item<Dim>(palette::kRattler, "rattler"));
  const auto moved = std::find_if(pictures.begin(), pictures.end(),
                                  [](const PackingPicture<Dim>& p) { return rms_displacement(p) > 0.0; });
  if (moved != pictures.end()) items.push_back(arrow_item(*moved, scale));
  if (!first.shade.value.empty()) items.push_back(color_bar(first.shade, width));
  for (const PackingPicture<Dim>& picture : pictures)
    if (!picture.note.empty() && pictures.size() == 1) items.push_back(text_item(picture.note));
  return items;
}

double legend_height(const std::vector<LegendItem>& items, double width) {
  return flow(items, width, [](const LegendItem&, double, int) {}) * kTextLine;
}

void draw_legend(cairo_t* page, const std::vector<LegendItem>& items, double left, double top, double width) {
  flow(items, width, [&](const LegendItem& item, double x, int line) {
    item.draw(page, left + x, top + kTextLine * line + kTextSize, width);
  });
}

template LegendItem force_item(const PackingPicture<2>&, const DrawnScale&);
template LegendItem force_item(const PackingPicture<3>&, const DrawnScale&);
template std::vector<LegendItem> legend_of(const std::vector<PackingPicture<2>>&, const DrawnScale&, double,
                                           double);
template std::vector<LegendItem> legend_of(const std::vector<PackingPicture<3>>&, const DrawnScale&, double,
                                           double);

}  // namespace floc
