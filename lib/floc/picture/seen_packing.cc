#include "floc/picture/seen_packing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "floc/picture/drawing_order.h"
#include "floc/picture/hidden_spheres.h"
#include "floc/picture/line_width.h"
#include "floc/picture/periodic_copies.h"

namespace floc {
namespace {

constexpr double kWithLines = 0.25;
/// A tube is drawn only if its length, divided by its width, is above this limit. Between spheres with their true
/// radii, shorter tubes would look like splinters at the contact point.
constexpr double kShortest = 0.05;
/// A face of the cell counts as seen edge-on if its unit normal has a component along the line of sight below this
/// limit.
constexpr double kEndOn = 1e-9;

using Interval = std::pair<double, double>;

/// Returns the interval of t in which a + b t + c t^2 < 0, for c >= 0.
std::optional<Interval> negative_part(double a, double b, double c) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (c == 0.0) return a < 0.0 ? std::optional(Interval{-kInfinite, kInfinite}) : std::nullopt;
  const double root = b * b - 4.0 * a * c;
  if (root <= 0.0) return std::nullopt;
  return Interval{(-b - std::sqrt(root)) / (2.0 * c), (-b + std::sqrt(root)) / (2.0 * c)};
}

/// Returns the part of a line segment that lies in the cell, as fractions of the length of the segment.
/// @param from,to  ends of the segment in reduced coordinates, which are between 0 and 1 in the cell
std::optional<Interval> part_in_cell(const Vec<3>& from, const Vec<3>& to) {
  Interval part{0.0, 1.0};
  for (int a = 0; a < 3; ++a) {
    const double step = to[a] - from[a];
    if (step == 0.0) {
      if (from[a] < 0.0 || from[a] >= 1.0) return std::nullopt;
      continue;
    }
    const double at_low = -from[a] / step, at_high = (1.0 - from[a]) / step;
    part.first = std::max(part.first, std::min(at_low, at_high));
    part.second = std::min(part.second, std::max(at_low, at_high));
  }
  return part.first < part.second ? std::optional(part) : std::nullopt;
}

/// Returns the radius of a sphere about the centre of a grain; the sphere lies inside the drawn facets of the grain.
/// For a rounded polyhedron, the sphere inside the core is used, because bevels lie inside the true surface, but
/// outside the core.
double radius_inside(const PlacedShape<3>& placed) {
  return placed.shape->n_faces() == 0 ? placed.rounding() : placed.inner_radius() - placed.rounding();
}

/// Collects the visible parts of a picture in 3D.
class Sight {
 public:
  Sight(const PackingPicture<3>& picture, const View& view, const DrawnScale& scale)
      : picture_(picture),
        scale_(scale),
        camera_(view),
        size_(sphere_size(picture, view)),
        diameter_(mean_diameter(picture) * scale.points_per_length) {
    for (const Vec<3>& x : picture.position) home_.push_back(picture.cell.wrapped(x));
    seen_.far = std::numeric_limits<double>::infinity();
    seen_.near = -seen_.far;
  }

  SeenPacking all() {
    if (picture_.shape.empty())
      add_spheres();
    else
      add_shapes();
    add_tubes();
    add_arrows();
    order();
    seen_.cell_edges = edges_of(picture_.cell, camera_, Vec<3>::Zero(), Vec<3>::Ones());
    if (const auto& slab = picture_.slab) {
      Vec<3> low = Vec<3>::Zero(), high = Vec<3>::Ones();
      low[slab->axis] = slab->from;
      high[slab->axis] = slab->to;
      seen_.slab_edges = edges_of(picture_.cell, camera_, low, high);
    }
    for (auto* edges : {&seen_.cell_edges, &seen_.slab_edges})
      for (SeenEdge& edge : *edges) hide(edge);
    return std::move(seen_);
  }

 private:
  using Part = SeenPacking::Part;

  /// Adds all spheres that are not hidden. Sets `far` and `near` to the smallest and the largest coordinate of sphere
  /// centres towards the eye; hidden spheres are included.
  void add_spheres() {
    for (int i = 0; i < static_cast<int>(home_.size()); ++i) {
      const Vec<3> centre = camera_.seen(home_[i]);
      widen_range(centre[2]);
      if (size_ > 0.0) seen_.spheres.push_back({centre, size_ * picture_.radius[i], i});
    }
    seen_.spheres = without_hidden(std::move(seen_.spheres));
    for (std::size_t k = 0; k < seen_.spheres.size(); ++k) mark(Part::sphere, k, seen_.spheres[k].centre[2]);
  }

  /// Does the work of add_spheres() for a packing with shapes other than spheres.
  void add_shapes() {
    std::vector<BodyExtent> extents;
    std::vector<PlacedShape<3>> placed;
    for (std::size_t i = 0; i < home_.size(); ++i) {
      placed.push_back(picture_.shape[i].at(home_[i], size_));
      extents.push_back({camera_.seen(home_[i]), radius_inside(placed.back()), placed.back().outer_radius()});
      widen_range(extents.back().centre[2]);
    }
    // Grains of size zero are not drawn. The range of depths was widened before this return, because tubes and arrows
    // become paler with depth, too.
    if (size_ == 0.0) return;
    const std::vector<bool> hidden = hidden_bodies(extents);
    std::vector<int> grains;
    std::vector<PlacedShape<3>> visible;
    for (std::size_t i = 0; i < home_.size(); ++i)
      if (!hidden[i]) grains.push_back(static_cast<int>(i)), visible.push_back(placed[i]);
    std::map<const Shape<3>*, Facets> facets;
    // order() later sorts all parts by depth. If the depth decreased along drawing_order(), this sort would undo the
    // order of the grains. Therefore each depth is at least the depth of the grains before.
    double depth = seen_.far;
    for (const int k : drawing_order(visible, camera_)) {
      const PlacedShape<3>& grain = visible[k];
      const Vec<3> centre = camera_.seen(grain.position);
      depth = std::max(depth, centre[2]);
      if (grain.shape->is_round()) {
        mark(Part::sphere, seen_.spheres.size(), depth);
        seen_.spheres.push_back({centre, grain.outer_radius(), grains[k]});
        continue;
      }
      const auto [found, is_new] = facets.try_emplace(grain.shape);
      if (is_new && grain.shape->n_faces() > 0) found->second = facets_of(*grain.shape);
      mark(Part::body, seen_.bodies.size(), depth);
      seen_.bodies.push_back(seen_body(grain, found->second, camera_, grains[k]));
    }
  }

  void widen_range(double depth) {
    seen_.far = std::min(seen_.far, depth);
    seen_.near = std::max(seen_.near, depth);
  }

  void mark(Part part, std::size_t index, double depth) {
    seen_.order.push_back({part, static_cast<int>(index), depth});
  }

  /// Returns the distance (length) from the centre of a body (a grain or a wall) to its drawn surface; 0 for a wall.
  /// @param direction  unit vector in space
  double drawn_reach(int body, const Vec<3>& direction) const {
    if (body >= static_cast<int>(home_.size())) return 0.0;
    if (picture_.is_round(body)) return size_ * picture_.radius[body];
    return distance_to_surface(picture_.shape[body].at(home_[body], size_), direction);
  }

  void add_tubes() {
    const PeriodicCopies<3> copies(picture_.cell);
    for (const ContactLine<3>& line : picture_.lines) {
      if (!line.through) {
        copies.of_segment(line.from, line.to, 0.0, [&](const Vec<3>& shift) {
          add_tube(line, {line.from + shift, line.i}, {line.to + shift, line.j});
        });
        continue;
      }
      copies.of_points({line.from, *line.through, line.to}, 0.0, [&](const Vec<3>& shift) {
        const End bend{*line.through + shift, std::nullopt};
        add_tube(line, {line.from + shift, line.i}, bend);
        add_tube(line, bend, {line.to + shift, line.j});
      });
    }
  }

  /// End of a tube: the centre of a grain, a point on a wall, or the point at which a line bends.
  struct End {
    Vec<3> x;
    std::optional<int> body;  ///< grain or wall; absent at a bend
  };

  /// Adds the tube of a contact. The tube begins where its surface meets the surface of the grain: on a sphere of
  /// radius R, at the distance sqrt(R^2 - (width/2)^2) from the centre.
  void add_tube(const ContactLine<3>& line, const End& from, const End& to) {
    const auto in_cell = part_in_cell(picture_.cell.reduced(from.x), picture_.cell.reduced(to.x));
    if (!in_cell) return;
    const double width = drawn_width(line, scale_, diameter_) / scale_.points_per_length;
    const double length = (to.x - from.x).norm();
    // The direction of a line without length is not defined.
    if (length == 0.0) return;
    const auto inside = [&](const End& end, const End& other) {
      if (!end.body) return 0.0;
      const double reach = drawn_reach(*end.body, (other.x - end.x) / length);
      return std::sqrt(std::max(0.0, std::pow(reach, 2) - 0.25 * width * width)) / length;
    };
    SeenTube tube;
    const double inside_from = inside(from, to), inside_to = inside(to, from);
    // Both the face of the cell and the surface of the grain may cut the line. The cut nearer to the middle of the line
    // decides where the tube ends, and whether this end is flat. If neither cuts the line, the end is round.
    const double begin = std::max(in_cell->first, inside_from);
    const double end = std::min(in_cell->second, 1.0 - inside_to);
    if ((end - begin) * length <= kShortest * width) return;
    tube.from = camera_.seen(from.x + begin * (to.x - from.x));
    tube.to = camera_.seen(from.x + end * (to.x - from.x));
    tube.from_end = begin > inside_from ? TubeEnd::cut : begin > 0.0 ? TubeEnd::at_sphere : TubeEnd::round;
    // A wall can only be the second body of a contact. The line ends on the wall itself, so without this test the tube
    // would have a round end, which would extend beyond the wall.
    const bool at_wall = to.body && *to.body >= static_cast<int>(home_.size());
    tube.to_end = at_wall || end < 1.0 - inside_to ? TubeEnd::cut
                  : end < 1.0                      ? TubeEnd::at_sphere
                                                   : TubeEnd::round;
    tube.width = width;
    tube.kind = line.kind;
    seen_.tubes.push_back(tube);
  }

  void add_arrows() {
    const double longer = scale_.points_per_displacement / scale_.points_per_length;
    for (const DisplacementArrow<3>& arrow : picture_.arrows) {
      const Vec<3> from = home_[arrow.grain];
      seen_.arrows.push_back({camera_.seen(from), camera_.seen(from + longer * arrow.displacement)});
    }
  }

  /// Inserts tubes and arrows into the drawing order of the grains.
  void order() {
    for (std::size_t k = 0; k < seen_.tubes.size(); ++k)
      mark(Part::tube, k, 0.5 * (seen_.tubes[k].from[2] + seen_.tubes[k].to[2]));
    for (std::size_t k = 0; k < seen_.arrows.size(); ++k)
      mark(Part::arrow, k, 0.5 * (seen_.arrows[k].from[2] + seen_.arrows[k].to[2]));
    std::stable_sort(seen_.order.begin(), seen_.order.end(),
                     [](const auto& a, const auto& b) { return a.depth < b.depth; });
  }

  void hide(SeenEdge& edge) const {
    std::vector<Interval> hidden;
    for (const SeenSphere& sphere : seen_.spheres)
      if (const auto part = hidden_part(edge.from, edge.to, sphere)) hidden.push_back(*part);
    for (const SeenBody& body : seen_.bodies) add_hidden_parts(edge.from, edge.to, body, hidden);
    std::sort(hidden.begin(), hidden.end());
    double free = 0.0;
    for (const Interval& part : hidden) {
      if (part.first > free) edge.visible.emplace_back(free, part.first);
      free = std::max(free, part.second);
    }
    if (free < 1.0) edge.visible.emplace_back(free, 1.0);
  }

  const PackingPicture<3>& picture_;
  const DrawnScale& scale_;
  Camera camera_;
  double size_;
  double diameter_;  ///< mean diameter of the grains (points)
  std::vector<Vec<3>> home_;
  SeenPacking seen_;
};

}  // namespace

double sphere_size(const PackingPicture<3>& picture, const View& view) {
  return view.sphere_size.value_or(picture.lines.empty() ? 1.0 : kWithLines);
}

SeenPacking seen_packing(const PackingPicture<3>& picture, const View& view, const DrawnScale& scale) {
  return Sight(picture, view, scale).all();
}

std::optional<std::pair<double, double>> hidden_part(const Vec<3>& from, const Vec<3>& to,
                                                     const SeenSphere& sphere) {
  const Vec<3> apart = from - sphere.centre, along = to - from;
  const Vec<2> apart2 = apart.head<2>(), along2 = along.head<2>();
  const double r2 = sphere.radius * sphere.radius;
  // A sphere hides all points inside the sphere. It also hides all points behind the sphere that lie in the cylinder of
  // the same radius along the line of sight. The union of sphere and cylinder is convex, so the hidden part of the
  // segment is a single interval.
  std::optional<Interval> cylinder =
      negative_part(apart2.squaredNorm() - r2, 2.0 * apart2.dot(along2), along2.squaredNorm());
  if (!cylinder) return std::nullopt;
  if (along[2] == 0.0) {
    if (apart[2] > 0.0) cylinder.reset();
  } else {
    const double at_equator = -apart[2] / along[2];
    if (along[2] > 0.0)
      cylinder->second = std::min(cylinder->second, at_equator);
    else
      cylinder->first = std::max(cylinder->first, at_equator);
    if (cylinder->first >= cylinder->second) cylinder.reset();
  }
  const std::optional<Interval> inside =
      negative_part(apart.squaredNorm() - r2, 2.0 * apart.dot(along), along.squaredNorm());
  if (!cylinder && !inside) return std::nullopt;
  Interval part = cylinder ? *cylinder : *inside;
  if (inside) part = {std::min(part.first, inside->first), std::max(part.second, inside->second)};
  part = {std::max(part.first, 0.0), std::min(part.second, 1.0)};
  return part.first < part.second ? std::optional(part) : std::nullopt;
}

std::vector<SeenEdge> edges_of(const Cell<3>& cell, const Camera& camera, const Vec<3>& low,
                               const Vec<3>& high) {
  const Mat<3> reciprocal = cell.matrix.transpose().inverse();
  std::vector<SeenEdge> edges;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper_b : {false, true})
      for (const bool upper_c : {false, true}) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        const auto looks_away = [&](int face, bool upper) {
          const Vec<3> normal = camera.seen(reciprocal.row(face).transpose().normalized());
          return (upper ? normal[2] : -normal[2]) <= kEndOn;
        };
        const bool away_b = looks_away(b, upper_b), away_c = looks_away(c, upper_c);
        Vec<3> from = low;
        if (upper_b) from[b] = high[b];
        if (upper_c) from[c] = high[c];
        Vec<3> to = from;
        to[axis] = high[axis];
        edges.push_back({camera.seen(cell.matrix.transpose() * from),
                         camera.seen(cell.matrix.transpose() * to),
                         axis,
                         away_b && away_c,
                         away_b != away_c,
                         {}});
      }
  return edges;
}

}  // namespace floc
