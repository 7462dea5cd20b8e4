#include "floc/picture/lattice_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "floc/lattice/node_grid.h"
#include "floc/picture/legend.h"
#include "floc/picture/page.h"

namespace floc {
namespace {

constexpr double kLatticeMargin = 8.0;  // margin around the picture (points)
constexpr double kMostPixels = 3000.0;

/// The plane that is drawn: in 2D the plane of the whole cell, in 3D a section through the cell.
template <int Dim>
struct Section {
  const Lattice<Dim>& lattice;
  int right, up;  // axes that point to the right and upwards in the picture
  int across;     // axis normal to the section; -1 in 2D
  double at;      // position of the section along the axis `across` (length)

  double width() const { return std::abs(lattice.cell.matrix(right, right)); }
  double height() const { return std::abs(lattice.cell.matrix(up, up)); }
  Vec<Dim> point(double x, double y) const {
    Vec<Dim> p = Vec<Dim>::Zero();
    p[right] = x, p[up] = y;
    if (across >= 0) p[across] = at;
    return p;
  }
};

template <int Dim>
Section<Dim> section_of(const Lattice<Dim>& lattice, const LatticeSheetOptions& options) {
  if constexpr (Dim == 2) return {lattice, 0, 1, -1, 0.0};
  const CrossSection& cut = options.cut;
  return {lattice, cut.right(), cut.up(), cut.axis, cut.at * std::abs(lattice.cell.matrix(cut.axis, cut.axis))};
}

template <int Dim>
int nearest_node(const NodeGrid<Dim>& grid, const Vec<Dim>& point, double spacing) {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  double reach = (Dim == 2 ? 0.6 : 1.0) * spacing;
  while (nearest < 0) {
    grid.near(point, reach, [&](int node, const Vec<Dim>& from, const auto&) {
      if (from.squaredNorm() < least) least = from.squaredNorm(), nearest = node;
    });
    reach *= 2.0;
  }
  return nearest;
}

/// Returns the periodic copy of the point x in the drawn box. The edges of this rectangular box are along the axes, and
/// their lengths are the diagonal elements of the cell matrix.
template <int Dim>
Vec<Dim> brought_into_room(const Cell<Dim>& cell, Vec<Dim> x) {
  // Cell vector a has no components along the axes after a. A shift by this vector therefore does not change the
  // coordinates along these axes. For this reason, the loop begins at the last axis.
  for (int a = Dim; a-- > 0;) {
    const double side = cell.matrix(a, a);
    const double times = std::floor(x[a] / std::abs(side));
    x -= std::copysign(1.0, side) * times * cell.matrix.row(a).transpose();
  }
  return x;
}

std::uint32_t pixel_of(const Color& c) {
  const auto byte = [](double x) { return static_cast<std::uint32_t>(std::lround(255.0 * x)); };
  return 0xff000000u | byte(c.red) << 16 | byte(c.green) << 8 | byte(c.blue);
}

/// Returns an image of the section through the lattice, in which each pixel has the colour of the nearest node.
template <int Dim>
cairo_surface_t* image_of(const Section<Dim>& section, const LatticePicture<Dim>& picture,
                          double pixels_a_length) {
  const int columns = std::max(1, static_cast<int>(std::lround(section.width() * pixels_a_length)));
  const int rows = std::max(1, static_cast<int>(std::lround(section.height() * pixels_a_length)));
  cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows);
  cairo_surface_flush(image);
  unsigned char* data = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  const NodeGrid<Dim> grid(section.lattice);
  for (int r = 0; r < rows; ++r) {
    auto* line = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(r) * stride);
    for (int c = 0; c < columns; ++c) {
      const Vec<Dim> at =
          section.point((c + 0.5) / columns * section.width(), (1.0 - (r + 0.5) / rows) * section.height());
      line[c] = pixel_of(picture.color[nearest_node(grid, at, section.lattice.spacing)]);
    }
  }
  cairo_surface_mark_dirty(image);
  return image;
}

void set_source(cairo_t* page, const Color& c) {
  cairo_set_source_rgb(page, c.red, c.green, c.blue);
}

/// Draws each broken bond (listed in `picture.faces`) as a line. The line is perpendicular to the bond, and goes
/// through the point at which the force of the bond acts. In 3D, a bond is drawn only if this point is within half a
/// lattice spacing of the section.
template <int Dim>
void draw_faces(cairo_t* page, const Section<Dim>& section, const LatticePicture<Dim>& picture, double scale) {
  set_source(page, palette::kArrow);
  cairo_set_line_width(page, std::max(0.4, 0.35 * section.lattice.spacing * scale));
  cairo_set_line_cap(page, CAIRO_LINE_CAP_ROUND);
  for (const int b : picture.faces) {
    const LatticeBond<Dim>& bond = section.lattice.bonds[b];
    const Vec<Dim> middle =
        brought_into_room<Dim>(section.lattice.cell, section.lattice.node[bond.i] + bond.arm_i);
    if (section.across >= 0 && std::abs(middle[section.across] - section.at) > 0.5 * section.lattice.spacing)
      continue;
    Vec<2> along(-bond.branch[section.up], bond.branch[section.right]);
    if (along.norm() == 0.0) continue;
    along *= 0.5 * (Dim == 2 ? bond.facet : section.lattice.spacing / 2.0) / along.norm();
    const double x = middle[section.right], y = section.height() - middle[section.up];
    cairo_move_to(page, (x - along[0]) * scale, (y + along[1]) * scale);
    cairo_line_to(page, (x + along[0]) * scale, (y - along[1]) * scale);
  }
  cairo_stroke(page);
}

LegendItem patch_item(const Color& color, const std::string& text) {
  constexpr double kSide = 9.0;
  return {kSide,
          [color](cairo_t* page, double x, double y) {
            cairo_rectangle(page, x, y - 0.5 * kSide, kSide, kSide);
            set_source(page, color);
            cairo_fill_preserve(page);
            set_source(page, palette::kOutline);
            cairo_set_line_width(page, 0.5);
            cairo_stroke(page);
          },
          text};
}

}  // namespace

std::vector<std::string> LatticeSheetOptions::validate() const {
  std::vector<std::string> faults;
  if (!(width >= 50.0 && width <= 5000.0))
    faults.push_back(fmt::format("width = {} points: must be 50 to 5000", width));
  for (const std::string& fault : cut.validate()) faults.push_back(fault);
  if (!kPixels.holds(pixels_a_node))
    faults.push_back(fmt::format("pixels per node = {}: must be 1 to 100", pixels_a_node));
  return faults;
}

std::vector<Color> stress_colors(const std::vector<double>& value, const std::vector<bool>& there,
                                 double largest) {
  assert(value.size() == there.size());
  std::vector<Color> color;
  for (std::size_t k = 0; k < value.size(); ++k)
    color.push_back(there[k] ? palette::diverging(value[k] / largest) : palette::kBackground);
  return color;
}

template <int Dim>
std::string draw_lattice(const Lattice<Dim>& lattice, const LatticePicture<Dim>& picture,
                         const LatticeSheetOptions& options) {
  assert(can_be_drawn(lattice.cell));
  refuse_faults(options.validate());
  assert(static_cast<int>(picture.color.size()) == lattice.n_nodes());
  const Section<Dim> section = section_of(lattice, options);
  const double inner = options.width - 2.0 * kLatticeMargin;
  const double scale = inner / section.width();
  std::vector<LegendItem> legend;
  for (const auto& [color, text] : picture.meanings) legend.push_back(patch_item(color, text));
  if (!picture.bar_name.empty())
    legend.push_back(color_bar({{}, picture.bar_largest, picture.bar_name}, inner));
  const double caption = picture.caption.empty() ? 0.0 : kTextLine;
  const double below = legend.empty() ? 0.0 : kLatticeMargin + legend_height(legend, inner);
  const double height = 2.0 * kLatticeMargin + caption + section.height() * scale + below;
  const double side = std::max(section.width(), section.height());
  const double pixels = std::min(options.pixels_a_node / lattice.spacing, kMostPixels / side);
  Page page(options.format, options.width, height, std::max(1.0, pixels / scale));
  cairo_t* to = page.context();
  set_font(to);
  if (caption > 0.0) draw_text(to, kLatticeMargin, kLatticeMargin + kTextSize, picture.caption);
  cairo_save(to);
  cairo_translate(to, kLatticeMargin, kLatticeMargin + caption);
  cairo_rectangle(to, 0.0, 0.0, inner, section.height() * scale);
  cairo_clip(to);
  cairo_surface_t* image = image_of(section, picture, pixels);
  cairo_save(to);
  cairo_scale(to, inner / cairo_image_surface_get_width(image),
              section.height() * scale / cairo_image_surface_get_height(image));
  cairo_set_source_surface(to, image, 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(to), CAIRO_FILTER_NEAREST);
  cairo_paint(to);
  cairo_restore(to);
  cairo_surface_destroy(image);
  draw_faces(to, section, picture, scale);
  cairo_restore(to);
  draw_legend(to, legend, kLatticeMargin, height - below, inner);
  return page.finish();
}

template std::string draw_lattice(const Lattice<2>&, const LatticePicture<2>&, const LatticeSheetOptions&);
template std::string draw_lattice(const Lattice<3>&, const LatticePicture<3>&, const LatticeSheetOptions&);

}  // namespace floc
