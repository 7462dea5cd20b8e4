#include "floc/picture/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/range.h"
#include "floc/picture/legend.h"
#include "floc/picture/packing_drawing.h"
#include "floc/picture/page.h"
#include "floc/picture/sphere_drawing.h"

namespace floc {
namespace {

constexpr double kMargin = 5.0;   ///< margin of the page (points)
constexpr double kGap = 12.0;     ///< distance between two pictures (points)
constexpr double kTallest = 1.3;  ///< largest height of a picture, divided by the width of the page
/// Smallest resolution of images, in pixels per point. Shaded spheres in 3D need more pixels than the flat colours of
/// 2D.
template <int Dim>
constexpr double kMinPixels = (Dim == 2 ? 200.0 : 300.0) / 72.0;
constexpr double kMaxPixelsPerSide = 3000.0;
constexpr double kPixelsPerDiameter = 6.0;
/// Largest number of shapes that are drawn as vectors. If there are more shapes, they are drawn as an image. The number
/// is smaller in 3D, where each round shape has its own colour gradient of about 600 bytes. Each facet of a grain with
/// corners counts as a shape.
template <int Dim>
constexpr std::size_t kMaxVectors = Dim == 2 ? 15000 : 6000;
constexpr double kAxisRoom = 10.0;  ///< margin around a picture in 3D for the names of the axes (points)

Box drawn_box(const PackingPicture<2>& picture, const SheetOptions&) {
  return box_of(picture.cell);
}

Box drawn_box(const PackingPicture<3>& picture, const SheetOptions& options) {
  return box_of(picture, options.view);
}

/// Positions (points) and scales of the pictures, the captions and the legend of a page.
template <int Dim>
class Layout {
 public:
  Layout(const std::vector<PackingPicture<Dim>>& pictures, const SheetOptions& options)
      : pictures_(pictures), options_(options), room_(Dim == 2 || options.bare ? 0.0 : kAxisRoom) {
    columns_ = std::min(options.columns, static_cast<int>(pictures.size()));
    Vec<2> largest = Vec<2>::Zero();
    for (const PackingPicture<Dim>& p : pictures)
      boxes_.push_back(drawn_box(p, options)), largest = largest.cwiseMax(boxes_.back().size());
    column_width_ = (inner_width() - (columns_ - 1) * kGap) / columns_;
    scale_.points_per_length = std::min((column_width_ - 2.0 * room_) / largest[0],
                                        (kTallest * inner_width() - 2.0 * room_) / largest[1]);
    set_scales();
    own_keys_ =
        pictures.size() > 1 && !options.same_force_scale && !options.bare && rms_force(pictures.front()) > 0.0;
    if (!options.bare) {
      legend_ = legend_of(pictures, scale_, std::min(100.0, 0.3 * column_width_), inner_width());
      if (!own_keys_ && rms_force(pictures.front()) > 0.0)
        legend_.insert(legend_.begin() + 1, force_item(pictures.front(), scale_));
      for (const PackingPicture<Dim>& p : pictures) captions_.push_back(caption_lines(p));
    }
    place();
  }

  double height() const { return height_; }
  double inner_width() const { return options_.width - 2.0 * kMargin; }
  double pixels_per_point() const {
    if (options_.resolution) return *options_.resolution / 72.0;
    double smallest = scale_.points_per_length * mean_diameter(pictures_.front());
    for (const PackingPicture<Dim>& p : pictures_)
      smallest = std::min(smallest, scale_.points_per_length * mean_diameter(p));
    const double most = kMaxPixelsPerSide / std::max(options_.width, height_);
    return std::min(std::max(kMinPixels<Dim>, kPixelsPerDiameter / smallest), std::max(most, kMinPixels<Dim>));
  }

  /// Returns the position and scales of each picture.
  const std::vector<Placement>& placements() const { return placements_; }
  const std::vector<Box>& boxes() const { return boxes_; }

  void draw_words(cairo_t* page) const {
    if (options_.bare) return;
    set_font(page);
    for (std::size_t k = 0; k < pictures_.size(); ++k) {
      const Placement& at = placements_[k];
      double baseline = at.top - room_ - 4.0;
      if (own_keys_) {
        force_item(pictures_[k], at.scale).draw(page, at.left - room_, baseline, column_width_);
        baseline -= kTextLine;
      }
      for (auto line = captions_[k].rbegin(); line != captions_[k].rend(); ++line, baseline -= kTextLine)
        draw_text(page, at.left - room_, baseline, *line);
    }
    draw_legend(page, legend_, kMargin, legend_top_, inner_width());
  }

 private:
  /// Sets the width of the line for a unit force, and the length of the arrow for a unit displacement (points).
  void set_scales() {
    double moved = 0.0, force = 0.0, force_diameter = 0.0;
    for (const PackingPicture<Dim>& p : pictures_) {
      moved = std::max(moved, rms_displacement(p));
      if (rms_force(p) > force) force = rms_force(p), force_diameter = mean_diameter(p);
    }
    const double diameter = scale_.points_per_length * mean_diameter(pictures_.front());
    if (moved > 0.0) scale_.points_per_displacement = diameter / moved;
    if (force > 0.0)
      scale_.points_per_force = options_.line_width * force_diameter * scale_.points_per_length / force;
  }

  void place() {
    std::size_t n_lines = own_keys_ ? 1 : 0;
    for (const auto& lines : captions_) n_lines = std::max(n_lines, lines.size() + (own_keys_ ? 1 : 0));
    const double above = static_cast<double>(n_lines) * kTextLine;
    double top = kMargin;
    for (std::size_t first = 0; first < pictures_.size(); first += static_cast<std::size_t>(columns_)) {
      const std::size_t end = std::min(pictures_.size(), first + static_cast<std::size_t>(columns_));
      double row = 0.0;
      for (std::size_t k = first; k < end; ++k) row = std::max(row, size_of(k)[1]);
      for (std::size_t k = first; k < end; ++k) {
        // A single picture is centred on the page. If there are several pictures, each is at the left of its column.
        const double left = pictures_.size() == 1 ? 0.5 * (inner_width() - size_of(k)[0])
                                                  : static_cast<double>(k - first) * (column_width_ + kGap);
        placements_.push_back({kMargin + left + room_, top + above + room_, scale_of(k)});
      }
      top += above + row + kGap;
    }
    legend_top_ = top - 2.0;
    height_ =
        legend_top_ + (legend_.empty() ? kMargin - kGap + 2.0 : legend_height(legend_, inner_width()) + 1.0);
  }

  std::vector<std::string> caption_lines(const PackingPicture<Dim>& picture) const {
    std::vector<std::string> lines;
    for (const std::string& part : picture.caption) {
      const std::string longer = lines.empty() ? part : lines.back() + "   " + part;
      if (!lines.empty() && text_width(longer) <= column_width_)
        lines.back() = longer;
      else if (text_width(part) <= column_width_)
        lines.push_back(part);
      else
        for (const std::string& line : wrapped_text(part, column_width_)) lines.push_back(line);
    }
    return lines;
  }

  Vec<2> size_of(std::size_t k) const {
    return (scale_.points_per_length * boxes_[k].size()).array() + 2.0 * room_;
  }

  DrawnScale scale_of(std::size_t k) const {
    DrawnScale scale = scale_;
    if (const double force = rms_force(pictures_[k]); force > 0.0 && !options_.same_force_scale)
      scale.points_per_force =
          options_.line_width * mean_diameter(pictures_[k]) * scale.points_per_length / force;
    return scale;
  }

  const std::vector<PackingPicture<Dim>>& pictures_;
  const SheetOptions& options_;
  double room_;  ///< margin around each picture (points)
  std::vector<Box> boxes_;
  int columns_ = 1;
  double column_width_ = 0.0;
  DrawnScale scale_;
  std::vector<LegendItem> legend_;
  std::vector<std::vector<std::string>> captions_;  ///< lines of the caption of each picture
  bool own_keys_ = false;  ///< whether each picture has its own force scale, shown beside its caption
  std::vector<Placement> placements_;
  double legend_top_ = 0.0;
  double height_ = 0.0;
};

/// A picture with its position on the page, ready to be drawn.
template <int Dim>
class Placed;

template <>
class Placed<2> {
 public:
  Placed(const PackingPicture<2>& picture, const Placement& at, const Box&, const SheetOptions&)
      : picture_(picture), at_(at) {}

  std::size_t n_marks() const {
    return picture_.position.size() + picture_.lines.size() + picture_.arrows.size();
  }
  void draw(cairo_t* page) const { draw_packing(page, picture_, at_); }
  void draw_frame(cairo_t* page) const { draw_cell(page, picture_, at_); }

 private:
  const PackingPicture<2>& picture_;
  const Placement& at_;
};

template <>
class Placed<3> {
 public:
  Placed(const PackingPicture<3>& picture, const Placement& at, const Box& box, const SheetOptions& options)
      : picture_(picture),
        at_(at),
        box_(box),
        bare_(options.bare),
        seen_(seen_packing(picture, options.view, at.scale)) {}

  std::size_t n_marks() const {
    std::size_t n = seen_.order.size();
    for (const SeenBody& body : seen_.bodies) n += body.facets.size();
    return n;
  }
  void draw(cairo_t* page) const { draw_seen(page, seen_, picture_, box_, at_); }
  void draw_frame(cairo_t* page) const {
    draw_front_edges(page, seen_, box_, at_);
    if (!bare_) draw_axes(page, seen_, box_, at_);
  }

 private:
  const PackingPicture<3>& picture_;
  const Placement& at_;
  const Box& box_;
  bool bare_;
  SeenPacking seen_;
};

}  // namespace

std::vector<std::string> SheetOptions::validate() const {
  std::vector<std::string> faults;
  const auto demand = [&faults](bool holds, const std::string& fault) {
    if (!holds) faults.push_back(fault);
  };
  demand(width >= 50.0 && width <= 5000.0,
         fmt::format("width = {} points: must be between 50 and 5000", width));
  demand(columns >= 1, fmt::format("columns = {}: must be at least 1", columns));
  demand(line_width > 0.0 && line_width <= 2.0,
         fmt::format("line width = {} mean diameters: must be above 0 and at most 2", line_width));
  demand(!resolution || (*resolution >= 10.0 && *resolution <= 2400.0),
         fmt::format("resolution = {} pixels per inch: must be between 10 and 2400", resolution.value_or(0.0)));
  for (const std::string& fault : view.validate()) faults.push_back(fault);
  return faults;
}

template <int Dim>
std::string draw_sheet(const std::vector<PackingPicture<Dim>>& pictures, const SheetOptions& options) {
  refuse_faults(options.validate());
  const Layout<Dim> layout(pictures, options);
  const double pixels = layout.pixels_per_point();
  std::vector<Placed<Dim>> placed;
  std::size_t n_marks = 0;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    placed.emplace_back(pictures[k], layout.placements()[k], layout.boxes()[k], options);
    n_marks += placed.back().n_marks();
  }
  // In svg and pdf files, grains and lines are embedded as an image if vector graphics would take megabytes. Frames,
  // axes and text are always vector graphics. A png file needs no embedded image.
  const bool as_image =
      options.format != PictureFormat::png && options.as_image.value_or(n_marks > kMaxVectors<Dim>);
  Page page(options.format, options.width, layout.height(), pixels);
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const Placement& at = layout.placements()[k];
    const Vec<2> size = at.scale.points_per_length * layout.boxes()[k].size();
    if (as_image) {
      const ImageLayer image(page.context(), at.left, at.top, size[0], size[1], pixels);
      placed[k].draw(image.context());
    } else {
      placed[k].draw(page.context());
    }
    placed[k].draw_frame(page.context());
  }
  layout.draw_words(page.context());
  return page.finish();
}

template std::string draw_sheet(const std::vector<PackingPicture<2>>&, const SheetOptions&);
template std::string draw_sheet(const std::vector<PackingPicture<3>>&, const SheetOptions&);

}  // namespace floc
