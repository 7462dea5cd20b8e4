#include "floc/picture/hidden_spheres.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace floc {
namespace {

constexpr double kTilesPerRadius = 8.0;
constexpr double kMaxTilesPerSide = 3000.0;

/// Square tiles into which the picture is divided in order to find hidden spheres. A tile is marked as soon as a single
/// sphere covers all of it.
class Tiles {
 public:
  /// Divides the rectangle around all spheres into tiles.
  /// @param finest  smallest radius (length); the width of a tile is an eighth of this radius
  Tiles(const std::vector<SeenSphere>& spheres, double finest) {
    low_.setConstant(std::numeric_limits<double>::infinity());
    Vec<2> high = -low_;
    for (const SeenSphere& s : spheres) {
      low_ = low_.cwiseMin((s.centre.head<2>().array() - s.radius).matrix());
      high = high.cwiseMax((s.centre.head<2>().array() + s.radius).matrix());
    }
    side_ = std::max(finest / kTilesPerRadius, (high - low_).maxCoeff() / kMaxTilesPerSide);
    columns_ = static_cast<int>((high[0] - low_[0]) / side_) + 1;
    covered_.assign(static_cast<std::size_t>(columns_) * (static_cast<int>((high[1] - low_[1]) / side_) + 1),
                    false);
  }

  /// Returns whether the sphere is hidden: whether earlier calls have marked all tiles that it overlaps. Also marks the
  /// tiles that lie within the sphere. @pre the function is called for the nearest sphere first, and for the farthest
  /// last
  bool hides_then_cover(const SeenSphere& s) {
    bool hidden = true;
    for_each_tile(s, [&hidden](auto tile, bool within) {
      hidden = hidden && tile;
      if (within) tile = true;
    });
    return hidden;
  }

  /// Returns whether all tiles that a sphere overlaps are marked.
  bool hides(const SeenSphere& s) {
    bool hidden = true;
    for_each_tile(s, [&hidden](auto tile, bool) { hidden = hidden && tile; });
    return hidden;
  }

  /// Marks the tiles that lie within a sphere.
  void cover(const SeenSphere& s) {
    for_each_tile(s, [](auto tile, bool within) {
      if (within) tile = true;
    });
  }

 private:
  /// Calls `act(tile, within)` for each tile that a sphere overlaps: `tile` is a reference to the mark of the tile, and
  /// `within` is true if the tile lies within the sphere.
  template <class Act>
  void for_each_tile(const SeenSphere& s, Act&& act) {
    const int first_row = row_of(s.centre[1] - s.radius, 1), last_row = row_of(s.centre[1] + s.radius, 1);
    const int first = row_of(s.centre[0] - s.radius, 0), last = row_of(s.centre[0] + s.radius, 0);
    const double r2 = s.radius * s.radius;
    for (int row = first_row; row <= last_row; ++row)
      for (int column = first; column <= last; ++column) {
        const auto [x_near, x_far] = distances(column, 0, s.centre[0]);
        const auto [y_near, y_far] = distances(row, 1, s.centre[1]);
        if (x_near * x_near + y_near * y_near >= r2) continue;
        act(covered_[static_cast<std::size_t>(row) * columns_ + column], x_far * x_far + y_far * y_far <= r2);
      }
  }

  int row_of(double x, int axis) const { return static_cast<int>((x - low_[axis]) / side_); }
  /// Returns the smallest and the largest distance from the coordinate `x` to the points of a column (axis 0) or row
  /// (axis 1) of tiles, measured along the axis.
  /// @param row  number of the column or row of tiles
  std::pair<double, double> distances(int row, int axis, double x) const {
    const double begin = low_[axis] + row * side_ - x, end = begin + side_;
    return {std::max({begin, -end, 0.0}), std::max(-begin, end)};
  }

  Vec<2> low_;
  double side_ = 1.0;
  int columns_ = 1;
  std::vector<bool> covered_;
};

}  // namespace

std::vector<SeenSphere> without_hidden(std::vector<SeenSphere> spheres) {
  if (spheres.empty()) return spheres;
  std::stable_sort(spheres.begin(), spheres.end(),
                   [](const auto& a, const auto& b) { return a.centre[2] > b.centre[2]; });
  double smallest = std::numeric_limits<double>::infinity();
  for (const SeenSphere& s : spheres) smallest = std::min(smallest, s.radius);
  Tiles tiles(spheres, smallest);
  std::erase_if(spheres, [&tiles](const SeenSphere& s) { return tiles.hides_then_cover(s); });
  return spheres;
}

std::vector<bool> hidden_bodies(const std::vector<BodyExtent>& bodies) {
  std::vector<bool> hidden(bodies.size(), false);
  if (bodies.empty()) return hidden;
  // The sphere inside a body can hide another body only if the nearest point of the other body is behind the centre of
  // the sphere. There are two events for each body: one at the depth of its centre, the other at the depth of its
  // nearest point. The events are sorted by depth.
  struct Event {
    double depth;
    /// true if the body is tested at this event; false if the body hides other bodies from this event on
    bool tests;
    std::size_t body;
  };
  std::vector<Event> events;
  std::vector<SeenSphere> outer;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const BodyExtent& body = bodies[k];
    events.push_back({body.centre[2] + body.outer, true, k});
    events.push_back({body.centre[2], false, k});
    outer.push_back({body.centre, body.outer, 0});
    smallest = std::min(smallest, body.inner);
  }
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
    return a.depth != b.depth ? a.depth > b.depth : a.tests < b.tests;
  });
  Tiles tiles(outer, smallest);
  for (const Event& event : events) {
    if (event.tests)
      hidden[event.body] = tiles.hides(outer[event.body]);
    else
      tiles.cover({bodies[event.body].centre, bodies[event.body].inner, 0});
  }
  return hidden;
}

}  // namespace floc
