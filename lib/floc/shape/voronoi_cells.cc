#include "floc/shape/voronoi_cells.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "floc/base/random.h"
#include "floc/shape/convex_hull.h"
#include "floc/shape/half_spaces.h"
#include "floc/shape/moments.h"
#include "floc/shape/random_streams.h"

namespace floc {
namespace {

/// Returns the vectors from point i to all points, including periodic images, that may determine the Voronoi cell of
/// point i. If there are at least 100 points, only the nearest image of each point is used; otherwise the images in the
/// adjacent boxes are used, too.
template <int Dim>
std::vector<Vec<Dim>> branches_from(const std::vector<Vec<Dim>>& points, std::size_t i) {
  const int reach = points.size() < 100 ? 1 : 0;
  std::vector<Vec<Dim>> branches;
  for (std::size_t j = 0; j < points.size(); ++j) {
    const Vec<Dim> direct = points[j] - points[i];
    const Vec<Dim> nearest = direct - direct.array().round().matrix();
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        for (int z = (Dim == 3 ? -reach : 0); z <= (Dim == 3 ? reach : 0); ++z) {
          Vec<Dim> branch = nearest;
          branch[0] += x, branch[1] += y;
          if constexpr (Dim == 3) branch[2] += z;
          if (branch.squaredNorm() > 0.0) branches.push_back(branch);
        }
  }
  return branches;
}

/// Returns the vertices of the Voronoi cell of a point, relative to the point.
/// @param branches  vectors from the point to the other points and their images; only the nearest of them are used
template <int Dim>
std::vector<Vec<Dim>> cell_of(std::vector<Vec<Dim>> branches) {
  for (std::size_t n_near = 40;; n_near *= 2) {
    const std::size_t n = std::min(n_near, branches.size());
    const auto nearer = [](const Vec<Dim>& a, const Vec<Dim>& b) { return a.squaredNorm() < b.squaredNorm(); };
    const auto middle = branches.begin() + static_cast<std::ptrdiff_t>(n);
    std::partial_sort(branches.begin(), middle, branches.end(), nearer);
    std::vector<HalfSpace<Dim>> half_spaces;
    for (std::size_t k = 0; k < n; ++k) half_spaces.push_back({branches[k], 0.5 * branches[k].squaredNorm()});
    const auto vertices = intersection_vertices<Dim>(half_spaces);
    // A neighbour cannot cut off a part of the cell if its distance from the centre point of the cell is more than
    // twice the distance of the furthest vertex from the centre point.
    double furthest = 0.0;
    if (vertices)
      for (const Vec<Dim>& v : *vertices) furthest = std::max(furthest, v.norm());
    if (vertices && branches[n - 1].norm() >= 2.0 * furthest) return *vertices;
    if (n == branches.size()) return vertices.value_or(std::vector<Vec<Dim>>());
  }
}

}  // namespace

template <int Dim>
std::vector<std::vector<Vec<Dim>>> voronoi_cells(int n, int relaxed, std::uint64_t seed) {
  RandomStream random(seed, kVoronoiStream);
  std::vector<Vec<Dim>> points(n);
  for (Vec<Dim>& p : points)
    for (int a = 0; a < Dim; ++a) p[a] = random.uniform();
  std::vector<std::vector<Vec<Dim>>> cells(n);
  for (int round = 0; round <= relaxed; ++round) {
    for (std::size_t i = 0; i < points.size(); ++i) cells[i] = cell_of<Dim>(branches_from<Dim>(points, i));
    if (round == relaxed) break;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (cells[i].empty()) continue;
      const Moments<Dim> moments = sharp_moments(convex_hull<Dim>(cells[i]).polytope);
      points[i] += moments.first / moments.volume;
      points[i] = (points[i].array() - points[i].array().floor()).matrix();
    }
  }
  return cells;
}

template std::vector<std::vector<Vec<2>>> voronoi_cells(int, int, std::uint64_t);
template std::vector<std::vector<Vec<3>>> voronoi_cells(int, int, std::uint64_t);

}  // namespace floc
