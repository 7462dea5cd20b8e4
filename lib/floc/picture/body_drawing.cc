#include "floc/picture/body_drawing.h"

#include <algorithm>
#include <cmath>

#include "floc/picture/shading.h"
#include "floc/picture/sphere_drawing.h"

namespace floc {
namespace {

/// Returns the unit vector towards the light source, in the coordinates of the viewer. A sphere is brightest where its
/// normal has this direction.
Vec<3> light() {
  constexpr double kFromAxis = 0.45;  // sine of the angle between the directions to the light and to the eye
  return {kFromAxis * kLight[0], -kFromAxis * kLight[1], std::sqrt(1.0 - kFromAxis * kFromAxis)};
}

/// Returns the colour of a facet. A facet has the shade of a sphere at the point with the same normal: dark at the rim,
/// pale at the brightest point.
Color shaded(const Color& color, const Vec<3>& normal) {
  constexpr double kDarkest = 0.6, kPalest = 0.6;
  // cosine of the angle between the normal and the light at which a facet keeps its colour
  constexpr double kPlain = 0.75;
  const double lit = std::max(0.0, normal.dot(light()));
  return lit < kPlain ? darker(color, kDarkest * (1.0 - lit / kPlain))
                      : paler(color, kPalest * (lit - kPlain) / (1.0 - kPlain));
}

void draw_capsule(cairo_t* page, const SeenBody& body, const std::function<Vec<2>(const Vec<3>&)>& on_page,
                  double points_per_length, const Color& color) {
  // length of the axis in the picture, divided by the radius, below which a capsule is drawn as a disk
  constexpr double kNearlyEndOn = 0.2;
  const Vec<2> from = on_page(body.points[0]), to = on_page(body.points[1]);
  const double radius = points_per_length * body.rounding;
  if ((to - from).norm() < kNearlyEndOn * radius)
    draw_ball(page, 0.5 * (from + to), radius + 0.5 * (to - from).norm(), color);
  else
    draw_bar(page, {from, to, 2.0 * radius, radius, radius}, color);
}

}  // namespace

void draw_body(cairo_t* page, const SeenBody& body, const std::function<Vec<2>(const Vec<3>&)>& on_page,
               double points_per_length, const Color& color) {
  // width of edges: largest width (points), and width divided by the radius of the body
  constexpr double kWidest = 0.5, kWidth = 0.03;
  // fractions by which an edge is darker than its facets, for sharp and for rounded edges
  constexpr double kSharp = 0.35, kRounded = 0.18;
  if (body.facets.empty()) return draw_capsule(page, body, on_page, points_per_length, color);
  // The edges are drawn together with each facet. The lines of the edges also cover the seams that antialiasing leaves
  // between facets.
  cairo_set_line_width(page, std::min(kWidest, kWidth * points_per_length * body.radius));
  cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
  for (const Facets::Facet& facet : body.facets) {
    cairo_new_path(page);
    for (const int corner : facet.corners) {
      const Vec<2> p = on_page(body.points[corner]);
      cairo_line_to(page, p[0], p[1]);
    }
    cairo_close_path(page);
    const Color fill = shaded(color, facet.normal);
    set_color(page, fill);
    cairo_fill_preserve(page);
    set_color(page, darker(fill, body.rounding > 0.0 ? kRounded : kSharp));
    cairo_stroke(page);
  }
  cairo_set_line_join(page, CAIRO_LINE_JOIN_MITER);
}

}  // namespace floc
