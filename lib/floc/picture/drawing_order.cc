#include "floc/picture/drawing_order.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "floc/shape/closest_points.h"
#include "floc/shape/manifold.h"

namespace floc {
namespace {

/// Let n be the unit normal of a plane that separates two bodies. If the component of n along the line of sight is not
/// above this limit in magnitude, neither body is in front of the other.
constexpr double kPlaneEndOn = 1e-9;

/// Returns the projection of a body onto the picture, with the centre of the body at the origin. Only the members that
/// closest_points() reads are set: vertices, rounding and outer radius. Some of the projected vertices may lie inside
/// the projection.
Shape<2> image_of(const PlacedShape<3>& body, const Camera& camera) {
  Shape<2> image;
  image.rounding = body.rounding();
  image.outer_radius = body.outer_radius();
  for (const Vec<3>& x : body.shape->vertices)
    image.vertices.push_back(camera.seen(body.scale * (body.rotation * x)).head<2>());
  return image;
}

/// Finds the pairs of bodies in which one body may cover the other, and sorts the bodies accordingly.
class Sorter {
 public:
  Sorter(const std::vector<PlacedShape<3>>& bodies, const Camera& camera)
      : bodies_(bodies), camera_(camera), nearer_(bodies.size()), n_farther_(bodies.size(), 0) {
    for (const PlacedShape<3>& body : bodies) {
      centre_.push_back(camera.seen(body.position));
      image_.push_back(image_of(body, camera));
      largest_ = std::max(largest_, body.outer_radius());
    }
  }

  std::vector<int> order() {
    find_pairs();
    return sorted();
  }

 private:
  using Tile = std::pair<int, int>;

  Tile tile_of(int i) const {
    return {static_cast<int>(std::floor(centre_[i][0] / (2.0 * largest_))),
            static_cast<int>(std::floor(centre_[i][1] / (2.0 * largest_)))};
  }

  /// Compares all pairs of bodies that may overlap in the picture. The picture is divided into square tiles. Each tile
  /// is as wide as the circumscribed circle of the largest body. Two bodies are compared if their centres are in the
  /// same tile or in adjacent tiles.
  void find_pairs() {
    std::map<Tile, std::vector<int>> in_tile;
    for (int i = 0; i < static_cast<int>(bodies_.size()); ++i) {
      const auto [column, row] = tile_of(i);
      for (int x = column - 1; x <= column + 1; ++x)
        for (int y = row - 1; y <= row + 1; ++y)
          if (const auto found = in_tile.find({x, y}); found != in_tile.end())
            for (const int j : found->second) compare(i, j);
      in_tile[{column, row}].push_back(i);
    }
  }

  void compare(int i, int j) {
    const Vec<3> apart = centre_[j] - centre_[i];
    const double radii = bodies_[i].outer_radius() + bodies_[j].outer_radius();
    if (apart.head<2>().norm() >= radii) return;
    if (!images_overlap(i, j, apart.head<2>())) return;
    const double towards_eye = normal_towards_eye(i, j, apart, radii);
    if (std::abs(towards_eye) <= kPlaneEndOn) return;
    const int far = towards_eye > 0.0 ? i : j, near = towards_eye > 0.0 ? j : i;
    nearer_[far].push_back(near);
    ++n_farther_[near];
  }

  /// Returns whether the images of two bodies overlap. If they do not, the two bodies can be drawn in any order. An
  /// order from a plane between these bodies would be unnecessary, and could contradict the orders of other pairs.
  bool images_overlap(int i, int j, const Vec<2>& apart) const {
    const RelativePlace<2> place(Mat<2>::Identity(), apart, 1.0);
    const Vec<2> guess = apart.isZero(0.0) ? Vec<2>(Vec<2>::Unit(0)) : apart;
    const ClosestPoints<2> closest = closest_points<2>(image_[i], image_[j], place, guess);
    return closest.overlap || closest.distance < image_[i].rounding + image_[j].rounding;
  }

  /// Finds a plane that separates the bodies i and j, and its normal from i to j (a unit vector, or the vector between
  /// the centres). Returns the component of the normal towards the eye.
  double normal_towards_eye(int i, int j, const Vec<3>& apart, double radii) const {
    // If the circumscribed spheres do not overlap, a plane normal to the line between the centres separates the bodies.
    if (apart.norm() >= radii) return apart[2];
    const Manifold<3> contact = contact_manifold(bodies_[i], bodies_[j], radii);
    return contact.n() > 0 ? camera_.seen(contact.normal)[2] : apart[2];
  }

  /// Returns the drawing order. A body is free if all bodies that it may cover have been drawn. Of the free bodies, the
  /// body with the farthest centre is drawn next.
  std::vector<int> sorted() {
    using Waiting = std::pair<double, int>;
    std::vector<Waiting> by_depth;
    for (int i = 0; i < static_cast<int>(bodies_.size()); ++i) by_depth.emplace_back(centre_[i][2], i);
    std::sort(by_depth.begin(), by_depth.end());
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> free;
    for (const Waiting& body : by_depth)
      if (n_farther_[body.second] == 0) free.push(body);
    std::vector<bool> taken(bodies_.size(), false);
    std::vector<int> order;
    auto farthest = by_depth.begin();
    while (order.size() < bodies_.size()) {
      int next = 0;
      if (free.empty()) {
        // Each remaining body is in a cycle, or in front of a body in a cycle.
        while (taken[farthest->second]) ++farthest;
        next = farthest->second;
      } else {
        next = free.top().second;
        free.pop();
      }
      taken[next] = true;
      order.push_back(next);
      for (const int i : nearer_[next])
        if (--n_farther_[i] == 0 && !taken[i]) free.emplace(centre_[i][2], i);
    }
    return order;
  }

  const std::vector<PlacedShape<3>>& bodies_;
  const Camera& camera_;
  std::vector<Vec<3>> centre_;            ///< centres in the coordinates of the viewer
  std::vector<Shape<2>> image_;           ///< images of the bodies, see image_of()
  double largest_ = 0.0;                  ///< largest circumscribed radius (length)
  std::vector<std::vector<int>> nearer_;  ///< for each body, the bodies that have to be drawn after it
  /// For each body, the number of bodies not yet drawn that have to precede it.
  std::vector<int> n_farther_;
};

}  // namespace

std::vector<int> drawing_order(const std::vector<PlacedShape<3>>& bodies, const Camera& camera) {
  return Sorter(bodies, camera).order();
}

}  // namespace floc
