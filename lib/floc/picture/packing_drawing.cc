#include "floc/picture/packing_drawing.h"

#include <array>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "floc/picture/line_width.h"
#include "floc/picture/outline.h"
#include "floc/picture/periodic_copies.h"

namespace floc {
namespace {

/// Largest number of shapes in one cairo path. The time for drawing a path increases faster than the number of its
/// shapes, so longer paths would be slower.
constexpr int kBatch = 200;
constexpr double kSmallestOutlined = 2.5;
/// Line widths are rounded to multiples of this width (points). Lines of equal width share one path, which keeps files
/// small.
constexpr double kWidthStep = 0.05;
constexpr int kShades = 64;

struct Segment {
  Vec<2> from, to;
};

/// Draws one picture of a 2D packing.
class Drawing {
 public:
  Drawing(cairo_t* page, const PackingPicture<2>& picture, const Placement& placement)
      : page_(page),
        picture_(picture),
        placement_(placement),
        box_(box_of(picture.cell)),
        copies_(picture.cell),
        diameter_(mean_diameter(picture) * placement.scale.points_per_length) {}

  Vec<2> on_page(const Vec<2>& x) const {
    const double s = placement_.scale.points_per_length;
    return {placement_.left + s * (x[0] - box_.low[0]), placement_.top + s * (box_.high[1] - x[1])};
  }

  void trace_cell() const {
    const Vec<2> a = picture_.cell.matrix.row(0), b = picture_.cell.matrix.row(1);
    cairo_new_path(page_);
    for (const Vec<2>& corner : {Vec<2>(Vec<2>::Zero()), a, Vec<2>(a + b), b}) {
      const Vec<2> p = on_page(corner);
      cairo_line_to(page_, p[0], p[1]);
    }
    cairo_close_path(page_);
  }

  void draw_grains() const {
    std::map<int, std::vector<int>> by_fill;
    for (int i = 0; i < static_cast<int>(picture_.position.size()); ++i) by_fill[fill_of(i)].push_back(i);
    cairo_set_line_width(page_, std::min(0.6, 0.035 * diameter_));
    for (const auto& [fill, grains] : by_fill) {
      const auto color = color_of_fill(fill);
      int n = 0;
      for (const int i : grains) {
        trace_copies(i, [&] {
          if (++n % kBatch == 0) paint_grains(color);
        });
      }
      paint_grains(color);
    }
  }

  void draw_lines() const {
    std::map<std::pair<LineKind, int>, std::vector<Segment>> by_width;
    for (const ContactLine<2>& line : picture_.lines) {
      const int level = static_cast<int>(std::lround(width_of(line) / kWidthStep));
      const double reach = 0.5 * width_of(line) / placement_.scale.points_per_length;
      const auto add = [&](const Vec<2>& shift) {
        std::vector<Segment>& segments = by_width[{line.kind, std::max(1, level)}];
        if (line.through) {
          segments.push_back({on_page(line.from + shift), on_page(*line.through + shift)});
          segments.push_back({on_page(*line.through + shift), on_page(line.to + shift)});
        } else {
          segments.push_back({on_page(line.from + shift), on_page(line.to + shift)});
        }
      };
      // Contacts with walls have no periodic copies.
      if (line.j >= static_cast<int>(picture_.position.size()))
        add(Vec<2>::Zero());
      else if (line.through)
        copies_.of_points({line.from, *line.through, line.to}, reach, add);
      else
        copies_.of_segment(line.from, line.to, reach, add);
    }
    cairo_set_line_cap(page_, CAIRO_LINE_CAP_ROUND);
    for (const auto& [kind_and_level, segments] : by_width) {
      set_color(page_, color_of(kind_and_level.first));
      cairo_set_line_width(page_, kWidthStep * kind_and_level.second);
      stroke(segments);
    }
  }

  void draw_arrows() const {
    set_color(page_, palette::kArrow);
    const double longer = placement_.scale.points_per_displacement / placement_.scale.points_per_length;
    for (const DisplacementArrow<2>& arrow : picture_.arrows) {
      const Vec<2> to = arrow.from + longer * arrow.displacement;
      copies_.of_segment(arrow.from, to, 0.0, [&](const Vec<2>& shift) {
        draw_arrow(page_, on_page(arrow.from + shift), on_page(to + shift), 0.05 * diameter_, 0.35 * diameter_);
      });
    }
  }

 private:
  /// Returns a number that identifies the fill colour of a grain. If the picture colours grains by a value, the
  /// number is the position of the value on the colour scale, from -kShades to kShades. Otherwise it is 1 for a
  /// rattler, and 0 for any other grain.
  int fill_of(int i) const {
    if (!picture_.shade.value.empty()) {
      const double share = std::clamp(picture_.shade.value[i] / picture_.shade.largest, -1.0, 1.0);
      return static_cast<int>(std::lround(share * kShades));
    }
    return !picture_.rattler.empty() && picture_.rattler[i];
  }
  Color color_of_fill(int fill) const {
    if (!picture_.shade.value.empty()) return palette::diverging(static_cast<double>(fill) / kShades);
    return fill == 0 ? palette::kGrain : palette::kRattler;
  }

  /// Adds the outlines of grain i and of its periodic copies to the path, and calls `traced()` after each outline.
  template <class Traced>
  void trace_copies(int i, Traced&& traced) const {
    const Vec<2>& centre = picture_.position[i];
    const bool has_outline = !picture_.outline.empty();
    if (!has_outline && picture_.is_round(i)) {
      return copies_.of_disk(centre, picture_.radius[i], [&](const Vec<2>& shift) {
        trace_disk(centre + shift, picture_.radius[i]);
        traced();
      });
    }
    const Outline outline = has_outline ? picture_.outline[i] : outline_of(picture_.shape[i].at(centre));
    std::vector<Vec<2>> centres;
    for (const OutlineCorner& corner : outline.corners) centres.push_back(corner.centre);
    copies_.of_points(centres, outline.radius, [&](const Vec<2>& shift) {
      trace_outline(outline, shift);
      traced();
    });
  }

  void trace_outline(const Outline& outline, const Vec<2>& shift) const {
    const double radius = outline.radius * placement_.scale.points_per_length;
    cairo_new_sub_path(page_);
    for (const OutlineCorner& corner : outline.corners) {
      const Vec<2> p = on_page(corner.centre + shift);
      // The y axis of the page points down. Arcs therefore turn in the opposite sense on the page.
      if (radius > 0.0)
        cairo_arc_negative(page_, p[0], p[1], radius, -corner.begin, -corner.end);
      else
        cairo_line_to(page_, p[0], p[1]);
    }
    cairo_close_path(page_);
  }

  void trace_disk(const Vec<2>& centre, double radius) const {
    const Vec<2> p = on_page(centre);
    cairo_new_sub_path(page_);
    cairo_arc(page_, p[0], p[1], radius * placement_.scale.points_per_length, 0.0, 2.0 * std::numbers::pi);
    cairo_close_path(page_);
  }

  void paint_grains(const Color& fill) const {
    set_color(page_, fill);
    if (diameter_ < kSmallestOutlined) return cairo_fill(page_);
    cairo_fill_preserve(page_);
    set_color(page_, palette::kOutline);
    cairo_stroke(page_);
  }

  double width_of(const ContactLine<2>& line) const { return drawn_width(line, placement_.scale, diameter_); }

  void stroke(const std::vector<Segment>& segments) const {
    int n = 0;
    for (const Segment& s : segments) {
      cairo_move_to(page_, s.from[0], s.from[1]);
      cairo_line_to(page_, s.to[0], s.to[1]);
      if (++n % kBatch == 0) cairo_stroke(page_);
    }
    cairo_stroke(page_);
  }

  cairo_t* page_;
  const PackingPicture<2>& picture_;
  const Placement& placement_;
  Box box_;
  PeriodicCopies<2> copies_;
  double diameter_;  ///< mean diameter of the grains (points)
};

}  // namespace

Box box_of(const Cell<2>& cell) {
  const Vec<2> a = cell.matrix.row(0), b = cell.matrix.row(1);
  Box box;
  for (const Vec<2>& corner : {a, Vec<2>(a + b), b}) {
    box.low = box.low.cwiseMin(corner);
    box.high = box.high.cwiseMax(corner);
  }
  return box;
}

void set_color(cairo_t* page, const Color& color) {
  cairo_set_source_rgb(page, color.red, color.green, color.blue);
}

Color color_of(LineKind kind) {
  switch (kind) {
    case LineKind::background:
      return palette::kBackground;
    case LineKind::zero:
      return palette::kZero;
    case LineKind::distant:
      return palette::kDistant;
    case LineKind::tension:
      return palette::kTension;
    case LineKind::compression:
      return palette::kCompression;
    case LineKind::lost:
      return palette::kLost;
    case LineKind::gained:
      return palette::kGained;
  }
  return palette::kText;
}

void draw_arrow(cairo_t* page, const Vec<2>& from, const Vec<2>& to, double width, double largest_head) {
  const double length = (to - from).norm();
  if (length == 0.0) return;
  const Vec<2> along = (to - from) / length, across(-along[1], along[0]);
  const double head = std::min(largest_head, 0.6 * length);
  const Vec<2> neck = to - head * along;
  cairo_set_line_width(page, width);
  cairo_move_to(page, from[0], from[1]);
  cairo_line_to(page, neck[0], neck[1]);
  cairo_stroke(page);
  for (const Vec<2>& corner : {to, Vec<2>(neck + 0.4 * head * across), Vec<2>(neck - 0.4 * head * across)})
    cairo_line_to(page, corner[0], corner[1]);
  cairo_close_path(page);
  cairo_fill(page);
}

void draw_packing(cairo_t* page, const PackingPicture<2>& picture, const Placement& placement) {
  const Drawing drawing(page, picture, placement);
  cairo_save(page);
  drawing.trace_cell();
  cairo_clip(page);
  drawing.draw_grains();
  drawing.draw_lines();
  drawing.draw_arrows();
  cairo_restore(page);
}

void draw_cell(cairo_t* page, const PackingPicture<2>& picture, const Placement& placement) {
  Drawing(page, picture, placement).trace_cell();
  set_color(page, palette::kCell);
  cairo_set_line_width(page, 0.5);
  cairo_stroke(page);
}

}  // namespace floc
