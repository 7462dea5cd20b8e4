#include "floc/shape/triangulated_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <utility>

#include "floc/base/error.h"

namespace floc {
namespace {

/// Edge between a triangle of the hull that is visible from a new point and a triangle that is hidden from the point.
struct HorizonEdge {
  int from, to;
  int beyond;       ///< index of the hidden triangle
  int beyond_edge;  ///< number of this edge in the triangle `beyond`
};

class HullBuilder {
 public:
  HullBuilder(const std::vector<Vec<3>>& points, const std::string& place) : points_(points) {
    Vec<3> low = points[0], high = points[0];
    for (const Vec<3>& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    size_ = (high - low).maxCoeff();
    tolerance_ = 1e-10 * size_;
    begin_with_a_tetrahedron(place);
  }

  /// Extends the hull until no point lies outside. Of the points above a triangle, the point furthest from the triangle
  /// is added first.
  std::vector<HullTriangle> build() {
    // Because of rounding errors, a point may be assigned to a wrong triangle. After the first round, the points
    // outside the hull are therefore assigned and added again, in two more rounds.
    for (int round = 0; round < 3; ++round) {
      hand_out(no_corners(), 0);
      for (std::size_t t = 0; t < faces_.size(); ++t)
        while (faces_[t].alive && !faces_[t].outside.empty()) take_furthest(static_cast<int>(t));
      bury();
    }
    return {faces_.begin(), faces_.end()};
  }

 private:
  struct Face : HullTriangle {
    /// Indices of the points that are assigned to this triangle; these points lie above the triangle.
    std::vector<int> outside;
    bool alive = true;
    int visited = -1;  ///< number of the last search that reached this triangle
  };

  double height(const Face& face, int point) const { return face.normal.dot(points_[point]) - face.offset; }

  int add_face(int a, int b, int c) {
    Face face;
    face.corner = {a, b, c};
    face.across = {-1, -1, -1};
    const Vec<3> normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    face.twice_area = normal.norm();
    if (face.twice_area > 0.0) face.normal = normal / face.twice_area;
    face.offset = face.normal.dot(points_[a] + points_[b] + points_[c]) / 3.0;
    faces_.push_back(std::move(face));
    return static_cast<int>(faces_.size()) - 1;
  }

  template <class Distance>
  int furthest(const Distance& distance) const {
    int best = 0;
    for (std::size_t i = 1; i < points_.size(); ++i)
      if (distance(points_[i]) > distance(points_[best])) best = static_cast<int>(i);
    return best;
  }

  void begin_with_a_tetrahedron(const std::string& place) {
    const int a = furthest([&](const Vec<3>& p) { return (p - points_[0]).squaredNorm(); });
    const int b = furthest([&](const Vec<3>& p) { return (p - points_[a]).squaredNorm(); });
    const Vec<3> line = (points_[b] - points_[a]).normalized();
    const int c = furthest([&](const Vec<3>& p) { return (p - points_[a]).cross(line).squaredNorm(); });
    const Vec<3> normal = line.cross(points_[c] - points_[a]).normalized();
    const int d = furthest([&](const Vec<3>& p) { return std::abs(normal.dot(p - points_[a])); });
    const double height = normal.dot(points_[d] - points_[a]);
    if (!(std::abs(height) > 1e-9 * size_))
      throw InputError(place, "all points lie in one plane: expected a polyhedron");
    // The four triangles of a tetrahedron, with corners counter-clockwise as seen from outside. The vertex d is the
    // apex above the base (a, e, f).
    const int e = height > 0.0 ? b : c, f = height > 0.0 ? c : b;
    add_face(a, f, e), add_face(a, e, d), add_face(e, f, d), add_face(f, a, d);
    faces_[0].across = {3, 2, 1};
    faces_[1].across = {0, 2, 3};
    faces_[2].across = {0, 3, 1};
    faces_[3].across = {0, 1, 2};
  }

  /// Assigns each point to a triangle: the first triangle with an index >= `first` above which the point lies.
  void hand_out(const std::vector<int>& points, std::size_t first) {
    for (const int i : points)
      for (std::size_t t = first; t < faces_.size(); ++t)
        if (faces_[t].alive && height(faces_[t], i) > tolerance_) {
          faces_[t].outside.push_back(i);
          break;
        }
  }

  void take_furthest(int t) {
    std::vector<int>& outside = faces_[t].outside;
    const auto best = std::max_element(outside.begin(), outside.end(), [&](int i, int j) {
      return height(faces_[t], i) < height(faces_[t], j);
    });
    const int point = *best;
    std::swap(*best, outside.back());
    outside.pop_back();
    // If the point lies in the planes of some triangles, the boundary of the visible region may consist of several
    // loops. In this case, triangles whose plane contains the point count as visible.
    for (const double threshold : {tolerance_, -tolerance_}) {
      const std::vector<int> seen = seen_from(point, t, threshold);
      if (const auto loop = horizon(seen)) {
        replace(seen, *loop, point);
        return;
      }
    }
  }

  std::vector<int> seen_from(int point, int start, double threshold) {
    std::vector<int> seen{start};
    const int mark = ++n_visits_;
    faces_[start].visited = mark;
    for (std::size_t k = 0; k < seen.size(); ++k)
      for (const int next : faces_[seen[k]].across)
        if (faces_[next].visited != mark && height(faces_[next], point) > threshold) {
          faces_[next].visited = mark;
          seen.push_back(next);
        }
    return seen;
  }

  /// Returns the edges around the region of the triangles `seen`, in order; no value if these edges form several loops.
  std::optional<std::vector<HorizonEdge>> horizon(const std::vector<int>& seen) const {
    std::vector<HorizonEdge> edges;
    for (const int t : seen)
      for (int k = 0; k < 3; ++k) {
        const int next = faces_[t].across[k];
        if (faces_[next].visited == n_visits_) continue;
        const int from = faces_[t].corner[k], to = faces_[t].corner[(k + 1) % 3];
        const auto& corner = faces_[next].corner;
        edges.push_back(
            {from, to, next, static_cast<int>(std::find(corner.begin(), corner.end(), to) - corner.begin())});
      }
    if (edges.size() < 3) return std::nullopt;
    std::sort(edges.begin(), edges.end(), [](const auto& e, const auto& f) { return e.from < f.from; });
    std::vector<HorizonEdge> loop;
    int at = edges.front().from;
    do {
      const auto edge = std::lower_bound(edges.begin(), edges.end(), at,
                                         [](const HorizonEdge& e, int from) { return e.from < from; });
      if (edge == edges.end() || edge->from != at) return std::nullopt;
      loop.push_back(*edge);
      at = edge->to;
    } while (at != edges.front().from && loop.size() <= edges.size());
    if (loop.size() != edges.size()) return std::nullopt;
    return loop;
  }

  void replace(const std::vector<int>& seen, const std::vector<HorizonEdge>& loop, int point) {
    const int first = static_cast<int>(faces_.size()), n = static_cast<int>(loop.size());
    for (int k = 0; k < n; ++k) {
      const int t = add_face(loop[k].from, loop[k].to, point);
      faces_[t].across = {loop[k].beyond, first + (k + 1) % n, first + (k + n - 1) % n};
      faces_[loop[k].beyond].across[loop[k].beyond_edge] = t;
    }
    for (const int t : seen) {
      faces_[t].alive = false;
      hand_out(std::exchange(faces_[t].outside, {}), static_cast<std::size_t>(first));
    }
  }

  /// Returns the points that are not a corner of any triangle.
  std::vector<int> no_corners() const {
    std::vector<bool> is_corner(points_.size(), false);
    for (const Face& face : faces_)
      for (const int i : face.corner) is_corner[i] = true;
    std::vector<int> others;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!is_corner[i]) others.push_back(static_cast<int>(i));
    return others;
  }

  /// Removes the triangles that are no longer part of the hull.
  void bury() {
    std::vector<int> number(faces_.size(), -1);
    int n = 0;
    for (std::size_t t = 0; t < faces_.size(); ++t)
      if (faces_[t].alive) number[t] = n++;
    std::erase_if(faces_, [](const Face& face) { return !face.alive; });
    for (Face& face : faces_)
      for (int& next : face.across) next = number[next];
  }

  const std::vector<Vec<3>>& points_;
  double size_ = 0.0;  ///< largest extent of the points
  /// points count as lying in a plane if their distance from the plane is less than this length
  double tolerance_ = 0.0;
  std::vector<Face> faces_;
  int n_visits_ = 0;
};

}  // namespace

std::vector<HullTriangle> triangulated_hull(const std::vector<Vec<3>>& points, const std::string& place) {
  return HullBuilder(points, place).build();
}

}  // namespace floc
