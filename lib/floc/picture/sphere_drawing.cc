#include "floc/picture/sphere_drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/picture/body_drawing.h"
#include "floc/picture/legend.h"
#include "floc/picture/shading.h"

namespace floc {
namespace {

/// Fractions of white in the colours of the parts farthest from the eye, in pictures without and with tubes. The
/// fraction is smaller without tubes, because grains of full size hide each other.
constexpr double kPaleSpheres = 0.25;
constexpr double kPaleTubes = 0.65;
/// Width of arrows and length of their heads, in mean diameters. Arrows are thinner than in 2D, because in 3D more
/// arrows overlap.
constexpr double kArrowWidth = 0.04;
constexpr double kArrowHead = 0.2;

void add_stop(cairo_pattern_t* pattern, double at, const Color& color) {
  cairo_pattern_add_color_stop_rgb(pattern, at, color.red, color.green, color.blue);
}

void fill_with(cairo_t* page, cairo_pattern_t* pattern) {
  cairo_set_source(page, pattern);
  cairo_fill(page);
  cairo_pattern_destroy(pattern);
}

/// Draws one picture of a packing in 3D.
class SeenDrawing {
 public:
  SeenDrawing(cairo_t* page, const SeenPacking& seen, const Box& box, const Placement& placement)
      : page_(page), seen_(seen), box_(box), placement_(placement), scale_(placement.scale.points_per_length) {}

  Vec<2> on_page(const Vec<3>& x) const {
    return {placement_.left + scale_ * (x[0] - box_.low[0]), placement_.top + scale_ * (box_.high[1] - x[1])};
  }

  void draw_back_edges() const {
    constexpr double kDashes[] = {2.5, 2.5};
    cairo_set_dash(page_, kDashes, 2, 0.0);
    cairo_set_line_width(page_, 0.5);
    set_color(page_, paler(palette::kCell, 0.3));
    for (const auto* edges : {&seen_.cell_edges, &seen_.slab_edges})
      for (const SeenEdge& edge : *edges)
        if (edge.behind) stroke(edge.from, edge.to);
    cairo_set_dash(page_, nullptr, 0, 0.0);
  }

  void draw_front_edges() const {
    cairo_set_line_cap(page_, CAIRO_LINE_CAP_ROUND);
    const bool slab = !seen_.slab_edges.empty();
    for (const auto* edges : {&seen_.cell_edges, &seen_.slab_edges}) {
      const bool main = !slab || edges == &seen_.slab_edges;
      set_color(page_, paler(palette::kCell, main ? 0.0 : 0.4));
      cairo_set_line_width(page_, main ? 0.7 : 0.5);
      for (const SeenEdge& edge : *edges)
        if (!edge.behind)
          for (const auto& [begin, end] : edge.visible)
            stroke(edge.from + begin * (edge.to - edge.from), edge.from + end * (edge.to - edge.from));
    }
  }

  void draw_marks(const PackingPicture<3>& picture) const {
    const double diameter = mean_diameter(picture) * scale_;
    // Grains, tubes and arrows are drawn in one common order, the farthest first. One pass for each kind of part would
    // be wrong, because a grain may cover a tube, and another tube may cover this grain.
    for (const SeenPacking::Mark& mark : seen_.order) {
      switch (mark.part) {
        case SeenPacking::Part::sphere: {
          const SeenSphere& s = seen_.spheres[mark.index];
          draw_ball(page_, on_page(s.centre), scale_ * s.radius, paler(color_of(picture, s.grain), pale(mark)));
          break;
        }
        case SeenPacking::Part::body: {
          const SeenBody& b = seen_.bodies[mark.index];
          draw_body(
              page_, b, [this](const Vec<3>& x) { return on_page(x); }, scale_,
              paler(color_of(picture, b.grain), pale(mark)));
          break;
        }
        case SeenPacking::Part::tube:
          draw_tube(seen_.tubes[mark.index], pale(mark));
          break;
        case SeenPacking::Part::arrow: {
          const SeenArrow& a = seen_.arrows[mark.index];
          set_color(page_, paler(palette::kArrow, pale(mark)));
          draw_arrow(page_, on_page(a.from), on_page(a.to), kArrowWidth * diameter, kArrowHead * diameter);
          break;
        }
      }
    }
  }

  void draw_axes() const {
    const Vec<2> middle =
        on_page(0.25 * (seen_.cell_edges[0].from + seen_.cell_edges[0].to + opposite().from + opposite().to));
    for (int axis = 0; axis < 3; ++axis)
      if (const SeenEdge* edge = labelled_edge(axis))
        draw_axis(on_page(edge->from), on_page(edge->to), middle, "xyz"[axis]);
  }

 private:
  void stroke(const Vec<3>& from, const Vec<3>& to) const {
    const Vec<2> a = on_page(from), b = on_page(to);
    cairo_move_to(page_, a[0], a[1]);
    cairo_line_to(page_, b[0], b[1]);
    cairo_stroke(page_);
  }

  double pale(const SeenPacking::Mark& mark) const {
    const double deep = seen_.near > seen_.far ? (seen_.near - mark.depth) / (seen_.near - seen_.far) : 0.0;
    return std::clamp(deep, 0.0, 1.0) * (seen_.tubes.empty() ? kPaleSpheres : kPaleTubes);
  }

  Color color_of(const PackingPicture<3>& picture, int grain) const {
    if (!picture.shade.value.empty())
      return palette::diverging(picture.shade.value[grain] / picture.shade.largest);
    if (!picture.rattler.empty() && picture.rattler[grain]) return palette::kRattler;
    return picture.lines.empty() ? palette::kSphere : palette::kNode;
  }

  void draw_tube(const SeenTube& tube, double pale) const {
    const Vec<3> along = (tube.to - tube.from).normalized();
    const double half = 0.5 * scale_ * tube.width;
    const Color color = paler(floc::color_of(tube.kind), pale);
    const auto bulge = [&](TubeEnd end) { return end == TubeEnd::round ? half : half * std::abs(along[2]); };
    const Bar bar = {on_page(tube.from), on_page(tube.to), 2.0 * half, bulge(tube.from_end),
                     bulge(tube.to_end)};
    draw_bar(page_, bar, color);
    // If both ends of a tube are cut, only the end that faces the eye is visible.
    if (tube.to_end == TubeEnd::cut && along[2] > 0.0) draw_cut(bar.to, along, half, color);
    if (tube.from_end == TubeEnd::cut && along[2] < 0.0) draw_cut(bar.from, along, half, color);
  }

  /// Draws the flat end of a tube.
  void draw_cut(const Vec<2>& at, const Vec<3>& along, double half, const Color& color) const {
    if (half < kSmallestShaded || std::abs(along[2]) < 0.05) return;
    cairo_save(page_);
    cairo_translate(page_, at[0], at[1]);
    cairo_rotate(page_, std::atan2(-along[1], along[0]));
    cairo_scale(page_, std::abs(along[2]), 1.0);
    cairo_new_path(page_);
    cairo_arc(page_, 0.0, 0.0, half, 0.0, 2.0 * std::numbers::pi);
    cairo_restore(page_);
    set_color(page_, paler(color, 0.25));
    cairo_fill_preserve(page_);
    set_color(page_, darker(color, 0.4));
    cairo_set_line_width(page_, std::min(0.4, 0.1 * half));
    cairo_stroke(page_);
  }

  /// Returns the edge of the cell that is parallel and diagonally opposite to the first edge.
  const SeenEdge& opposite() const { return seen_.cell_edges[3]; }

  /// Returns the edge of the cell beside which the name of an axis is drawn; null if the axis is seen end-on. The edge
  /// is along this axis and belongs to the outline of the cell. It is the lowest of these edges on the page or, of
  /// several equally low edges, the leftmost.
  const SeenEdge* labelled_edge(int axis) const {
    constexpr double kShortestLabelled = 30.0, kLevel = 1.0;
    const SeenEdge* best = nullptr;
    Vec<2> best_middle = Vec<2>::Zero();
    for (const SeenEdge& edge : seen_.cell_edges) {
      if (edge.axis != axis || !edge.outline) continue;
      const Vec<2> from = on_page(edge.from), to = on_page(edge.to), middle = 0.5 * (from + to);
      if ((to - from).norm() < kShortestLabelled) continue;
      const bool lower = middle[1] > best_middle[1] + kLevel;
      const bool level = middle[1] > best_middle[1] - kLevel;
      if (best == nullptr || lower || (level && middle[0] < best_middle[0])) best = &edge, best_middle = middle;
    }
    return best;
  }

  /// Returns the distance (points) that a label has to keep from a point of the outline of the cell, in the direction
  /// `out`, so that the label overlaps no grain.
  /// @param length  length of the label along the outline (points)
  double clear_of_grains(const Vec<2>& point, const Vec<2>& along, const Vec<2>& out, double length) const {
    constexpr double kClearance = 4.0;
    double away = 0.0;
    const auto keep_clear_of = [&](const Vec<3>& centre, double radius_in_space) {
      const Vec<2> to = on_page(centre) - point;
      const double radius = scale_ * radius_in_space;
      const double beside = std::max(0.0, std::abs(to.dot(along)) - 0.5 * length);
      if (beside < radius) away = std::max(away, to.dot(out) + std::sqrt(radius * radius - beside * beside));
    };
    for (const SeenSphere& s : seen_.spheres) keep_clear_of(s.centre, s.radius);
    for (const SeenBody& b : seen_.bodies) keep_clear_of(b.centre, b.radius);
    return away + kClearance;
  }

  /// Draws a labelled arrow for an axis beside a cell edge.
  /// @param middle  middle of the cell; the arrow is drawn on the other side of the edge
  void draw_axis(const Vec<2>& from, const Vec<2>& to, const Vec<2>& middle, char name) const {
    constexpr double kLength = 18.0, kLetter = 5.0, kLeast = 6.0;
    const Vec<2> along = (to - from).normalized(), half_way = 0.5 * (from + to);
    Vec<2> out(-along[1], along[0]);
    if (out.dot(half_way - middle) < 0.0) out = -out;
    const double away = std::max(kLeast, clear_of_grains(half_way, along, out, kLength + 4.0 * kLetter));
    const Vec<2> begin = half_way + away * out - 0.5 * kLength * along;
    const Vec<2> end = begin + kLength * along;
    set_color(page_, palette::kText);
    draw_arrow(page_, begin, end, 0.6, 4.0);
    set_font(page_);
    const Vec<2> letter = end + kLetter * along;
    const std::string text(1, name);
    draw_text(page_, letter[0] - 0.5 * text_width(text), letter[1] + 0.27 * kTextSize, text);
  }

  cairo_t* page_;
  const SeenPacking& seen_;
  const Box& box_;
  const Placement& placement_;
  double scale_;
};

}  // namespace

Box box_of(const PackingPicture<3>& picture, const View& view) {
  const Camera camera(view);
  Box box;
  const auto hold = [&box](const Vec<3>& centre, double radius) {
    box.low = box.low.cwiseMin((centre.head<2>().array() - radius).matrix());
    box.high = box.high.cwiseMax((centre.head<2>().array() + radius).matrix());
  };
  for (const SeenEdge& edge : edges_of(picture.cell, camera, Vec<3>::Zero(), Vec<3>::Ones()))
    for (const Vec<3>& corner : {edge.from, edge.to}) hold(corner, 0.0);
  const double size = sphere_size(picture, view);
  for (std::size_t i = 0; i < picture.position.size(); ++i)
    hold(camera.seen(picture.cell.wrapped(picture.position[i])), size * picture.radius[i]);
  return box;
}

void draw_ball(cairo_t* page, const Vec<2>& centre, double radius, const Color& color) {
  cairo_new_path(page);
  cairo_arc(page, centre[0], centre[1], radius, 0.0, 2.0 * std::numbers::pi);
  cairo_close_path(page);
  if (radius < kSmallestShaded) {
    set_color(page, darker(color, 0.15));
    return cairo_fill(page);
  }
  const Vec<2> lit = centre + 0.45 * radius * kLight;
  cairo_pattern_t* gradient = cairo_pattern_create_radial(lit[0], lit[1], 0.0, centre[0], centre[1], radius);
  add_stop(gradient, 0.0, paler(color, 0.85));
  add_stop(gradient, 0.35, paler(color, 0.15));
  add_stop(gradient, 0.75, darker(color, 0.18));
  add_stop(gradient, 0.95, darker(color, 0.45));
  add_stop(gradient, 1.0, darker(color, 0.6));
  fill_with(page, gradient);
}

void draw_bar(cairo_t* page, const Bar& bar, const Color& color) {
  const double length = (bar.to - bar.from).norm(), half = 0.5 * bar.width;
  const Vec<2> along = length > 0.0 ? Vec<2>((bar.to - bar.from) / length) : Vec<2>(1.0, 0.0);
  const Vec<2> across(-along[1], along[0]);
  const double lit = across.dot(kLight);
  cairo_save(page);
  cairo_translate(page, bar.from[0], bar.from[1]);
  cairo_rotate(page, std::atan2(along[1], along[0]));
  cairo_new_path(page);
  // The outline of a round end is half a circle. The outline of a flat end is half an ellipse, or a straight line if
  // the end is seen edge-on. The straight line is drawn separately, because cairo cannot scale an arc by zero.
  const auto end_at = [&](double x, double bulge, double begin) {
    if (bulge <= 1e-3 * half) {
      cairo_line_to(page, x, begin < 0.0 ? -half : half);
      cairo_line_to(page, x, begin < 0.0 ? half : -half);
      return;
    }
    cairo_save(page);
    cairo_translate(page, x, 0.0);
    cairo_scale(page, bulge / half, 1.0);
    cairo_arc(page, 0.0, 0.0, half, begin, begin + std::numbers::pi);
    cairo_restore(page);
  };
  end_at(length, bar.bulge_to, -0.5 * std::numbers::pi);
  end_at(0.0, bar.bulge_from, 0.5 * std::numbers::pi);
  cairo_close_path(page);
  // Bars that are too thin to show a gradient have a single colour, which keeps files small.
  if (half < kSmallestShaded) {
    set_color(page, darker(color, 0.1));
    cairo_fill(page);
    return cairo_restore(page);
  }
  // The brightest line along the bar is on the side of the light. The distance of this line from the middle of the bar
  // increases with the angle between the light and the bar.
  cairo_pattern_t* gradient = cairo_pattern_create_linear(0.0, -half, 0.0, half);
  add_stop(gradient, 0.0, darker(color, 0.45));
  add_stop(gradient, 0.18, darker(color, 0.1));
  add_stop(gradient, 0.5 + 0.2 * lit, paler(color, 0.45));
  add_stop(gradient, 0.82, darker(color, 0.1));
  add_stop(gradient, 1.0, darker(color, 0.45));
  fill_with(page, gradient);
  cairo_restore(page);
}

void draw_seen(cairo_t* page, const SeenPacking& seen, const PackingPicture<3>& picture, const Box& box,
               const Placement& placement) {
  const SeenDrawing drawing(page, seen, box, placement);
  drawing.draw_back_edges();
  drawing.draw_marks(picture);
}

void draw_front_edges(cairo_t* page, const SeenPacking& seen, const Box& box, const Placement& placement) {
  SeenDrawing(page, seen, box, placement).draw_front_edges();
}

void draw_axes(cairo_t* page, const SeenPacking& seen, const Box& box, const Placement& placement) {
  SeenDrawing(page, seen, box, placement).draw_axes();
}

}  // namespace floc
