#include "floc/shape/convex_hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "floc/base/error.h"
#include "floc/shape/cross_product.h"
#include "floc/shape/triangulated_hull.h"

namespace floc {
namespace {

/// Two adjacent faces are merged if the length of the cross product of their unit normals is less than this number.
constexpr double kOneDirection = 1e-6;

/// Smallest box along the axes that contains all points.
template <int Dim>
struct Box {
  Vec<Dim> low, high;

  /// @param points  at least one point
  explicit Box(const std::vector<Vec<Dim>>& points) : low(points[0]), high(points[0]) {
    for (const Vec<Dim>& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  double extent() const { return (high - low).maxCoeff(); }
};

template <int Dim>
void require_points(const std::vector<Vec<Dim>>& points, const std::string& place) {
  const int n = static_cast<int>(points.size());
  if (n <= Dim)
    throw InputError(place, fmt::format("found {} points, expected at least {} points that do not lie {}", n,
                                        Dim + 1, Dim == 2 ? "on one line" : "in one plane"));
  if (n > kMostHullPoints)
    throw InputError(place, fmt::format("found {} points, expected at most {} points", n, kMostHullPoints));
  for (int i = 0; i < n; ++i)
    if (!points[i].allFinite() || points[i].cwiseAbs().maxCoeff() > kLargestLength)
      throw InputError(
          place, fmt::format("point {}: expected coordinates that are finite numbers from {:g} to {:g}", i + 1,
                             -kLargestLength, kLargestLength));
  const double extent = Box<Dim>(points).extent();
  if (extent > 0.0 && extent < kLeastLength)
    throw InputError(place, fmt::format("the largest extent of the points is {:g}: expected at least {:g}",
                                        extent, kLeastLength));
}

/// Requires that the bounding box of the convex hull equals the bounding box of the given points, up to 1e-5 of the
/// largest extent. The hull is smaller if vertices were mistaken for points on an edge, for example at the end of a
/// needle that is a million times as long as it is thick.
void require_whole(const Polytope<3>& hull, const std::vector<Vec<3>>& points, const std::string& place) {
  const Box<3> all(points), kept(hull.vertices);
  const double missing = std::max((kept.low - all.low).maxCoeff(), (all.high - kept.high).maxCoeff());
  if (missing > 1e-5 * all.extent())
    throw InputError(place, "all points lie nearly on one line or in one plane: expected a polyhedron");
}
void require_whole(const Polytope<2>&, const std::vector<Vec<2>>&, const std::string&) {}

/// Removes the corners at which the boundary of a polygon changes its direction by less than kOneDirection.
void drop_straight_corners(const std::vector<Vec<2>>& points, std::vector<int>& loop) {
  for (std::size_t k = 0; k < loop.size() && loop.size() > 2;) {
    const std::size_t n = loop.size();
    const Vec<2> before = points[loop[k]] - points[loop[(k + n - 1) % n]];
    const Vec<2> after = points[loop[(k + 1) % n]] - points[loop[k]];
    if (before.dot(after) >= 0.0 &&
        cross_product(before, after) <= kOneDirection * before.norm() * after.norm()) {
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(k));
      k = k > 0 ? k - 1 : 0;
    } else {
      ++k;
    }
  }
}

/// Returns the corners of the convex hull of points in the plane, counter-clockwise, beginning with the corner
/// of lowest index.
std::vector<int> corners_in_plane(const std::vector<Vec<2>>& points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    return std::pair(points[i][0], points[i][1]) < std::pair(points[j][0], points[j][1]);
  });
  std::vector<int> loop;
  for (const int side : {0, 1}) {
    const std::size_t first = loop.size();
    for (std::size_t k = 0; k < order.size(); ++k) {
      const int i = side == 0 ? order[k] : order[order.size() - 1 - k];
      while (loop.size() >= first + 2 && cross_product(points[loop.back()] - points[loop[loop.size() - 2]],
                                                       points[i] - points[loop.back()]) <= 0.0)
        loop.pop_back();
      loop.push_back(i);
    }
    loop.pop_back();  // this corner is also the first corner of the other half of the hull
  }
  drop_straight_corners(points, loop);
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

/// Returns for each triangle the number of the face to which it belongs. Adjacent triangles with almost equal normals
/// are merged. The normal of a very thin triangle is inaccurate; such a triangle is merged with the neighbour at its
/// longest edge.
std::vector<int> joined_faces(const std::vector<Vec<3>>& points, const std::vector<HullTriangle>& triangles) {
  std::vector<int> group(triangles.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int t) {
    while (group[t] != t) t = group[t] = group[group[t]];
    return t;
  };
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    const HullTriangle& one = triangles[t];
    int longest = 0;
    double length = 0.0;
    for (int k = 0; k < 3; ++k) {
      const HullTriangle& other = triangles[one.across[k]];
      const double edge = (points[one.corner[(k + 1) % 3]] - points[one.corner[k]]).norm();
      if (edge > length) length = edge, longest = k;
      if (one.normal.dot(other.normal) > 0.0 && one.normal.cross(other.normal).norm() < kOneDirection)
        group[root(t)] = root(one.across[k]);
    }
    if (one.twice_area < 1e-7 * length * length) group[root(t)] = root(one.across[longest]);
  }
  for (int t = 0; t < static_cast<int>(group.size()); ++t) group[t] = root(t);
  return group;
}

/// Returns the vertices around each face of the convex hull. A face consists of one triangle or of several merged
/// triangles.
/// @throws InputError if a face has a hole or touches itself
std::vector<std::vector<int>> face_loops(const std::vector<Vec<3>>& points, const std::string& place) {
  const std::vector<HullTriangle> triangles = triangulated_hull(points, place);
  const std::vector<int> group = joined_faces(points, triangles);
  std::vector<std::vector<std::pair<int, int>>> borders(triangles.size());
  // The boundary of a face consists of the edges between a triangle of the face and a triangle of another face. The
  // edges inherit the direction of their triangles, so the boundary is counter-clockwise as seen from outside.
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (group[triangles[t].across[k]] != group[t])
        borders[group[t]].emplace_back(triangles[t].corner[k], triangles[t].corner[(k + 1) % 3]);
  std::vector<std::vector<int>> loops;
  for (std::vector<std::pair<int, int>>& border : borders) {
    if (border.empty()) continue;
    // The edges are sorted by their first corner, because std::lower_bound() below finds the edge that begins at a
    // corner.
    std::sort(border.begin(), border.end());
    std::vector<int>& loop = loops.emplace_back();
    int at = border.front().first;
    do {
      loop.push_back(at);
      const auto next = std::lower_bound(border.begin(), border.end(), std::pair(at, -1));
      at = next != border.end() && next->first == at ? next->second : -1;
    } while (at >= 0 && at != border.front().first && loop.size() <= border.size());
    // The walk follows one closed curve. If the face has a hole or touches itself, some of its edges are not on this
    // curve, and the numbers of corners and edges differ. The limit of the loop size above ends a walk that never
    // returns to its first corner.
    if (at < 0 || loop.size() != border.size())
      throw InputError(
          place,
          "two faces of the convex hull are almost parallel, and their common boundary cannot be "
          "determined: expected points whose adjacent faces enclose an angle of more than 1e-6 radians");
  }
  return loops;
}

/// Removes from all faces the corners that belong to fewer than three faces. These corners lie on edges and are not
/// vertices of the polyhedron.
void drop_corners_on_edges(std::size_t n_points, std::vector<std::vector<int>>& loops) {
  std::vector<int> n_faces(n_points, 0);
  for (const std::vector<int>& loop : loops)
    for (const int i : loop) ++n_faces[i];
  for (std::vector<int>& loop : loops) std::erase_if(loop, [&](int i) { return n_faces[i] < 3; });
  std::erase_if(loops, [](const std::vector<int>& loop) { return loop.size() < 3; });
}

std::vector<std::vector<int>> loops_of(const std::vector<Vec<3>>& points, const std::string& place) {
  std::vector<std::vector<int>> loops = face_loops(points, place);
  drop_corners_on_edges(points.size(), loops);
  if (loops.size() < 4) throw InputError(place, "all points lie nearly in one plane: expected a polyhedron");
  for (std::vector<int>& loop : loops)
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  std::sort(loops.begin(), loops.end());
  return loops;
}

std::vector<std::vector<int>> loops_of(const std::vector<Vec<2>>& points, const std::string& place) {
  const std::vector<int> corners = corners_in_plane(points);
  if (corners.size() < 3) throw InputError(place, "all points lie on one line: expected a polygon");
  std::vector<std::vector<int>> loops;
  for (std::size_t k = 0; k < corners.size(); ++k)
    loops.push_back({corners[k], corners[(k + 1) % corners.size()]});
  return loops;
}

}  // namespace

template <int Dim>
ConvexHull<Dim> convex_hull(const std::vector<Vec<Dim>>& points, const std::string& place) {
  require_points<Dim>(points, place);
  ConvexHull<Dim> hull;
  hull.polytope.faces = loops_of(points, place);
  std::vector<int>& used = hull.points;
  for (const std::vector<int>& loop : hull.polytope.faces) used.insert(used.end(), loop.begin(), loop.end());
  // The vertices of a polygon are ordered around the polygon, the vertices of a polyhedron like the given points.
  if constexpr (Dim == 2) {
    used.clear();
    for (const std::vector<int>& loop : hull.polytope.faces) used.push_back(loop[0]);
  } else {
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
  }
  std::vector<int> number(points.size(), -1);
  for (std::size_t k = 0; k < used.size(); ++k) {
    number[used[k]] = static_cast<int>(k);
    hull.polytope.vertices.push_back(points[used[k]]);
  }
  for (std::vector<int>& loop : hull.polytope.faces)
    for (int& i : loop) i = number[i];
  require_whole(hull.polytope, points, place);
  return hull;
}

template ConvexHull<2> convex_hull(const std::vector<Vec<2>>&, const std::string&);
template ConvexHull<3> convex_hull(const std::vector<Vec<3>>&, const std::string&);

}  // namespace floc
