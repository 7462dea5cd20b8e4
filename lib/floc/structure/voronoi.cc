#include "floc/structure/voronoi.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <voro++/voro++.hh>

#include "floc/base/disjoint_sets.h"
#include "floc/neighbors/pairs.h"
#include "floc/packing/grain_sizes.h"
#include "floc/structure/turned_cell.h"

namespace floc {
namespace {

/// Distance below which vertices of the tessellation are merged, in units of the largest diameter. This distance is
/// larger than rounding errors, but smaller than the errors of the positions in packings.
constexpr double kSameVertex = 1e-6;

/// A vertex of the Voronoi cell of one grain.
struct Corner {
  Vec<3> at;
  double to_surface;  ///< distance from the vertex to the surface of the grain (length)
};

/// Computes the Voronoi cells of all grains. Sets their volumes and returns their vertices.
std::vector<Corner> tessellate(const Packing<3>& packing, std::vector<double>& volume) {
  const Grains<3>& g = packing.grains;
  const TurnedCell turned(packing.cell, g.size());
  const Mat<3>& l = turned.lattice;
  voro::container_periodic_poly container(l(0, 0), l(1, 0), l(1, 1), l(2, 0), l(2, 1), l(2, 2),
                                          turned.blocks(0), turned.blocks(1), turned.blocks(2),
                                          TurnedCell::kMemoryPerBlock);
  for (int i = 0; i < g.size(); ++i) {
    const Vec<3> x = turned.there(g.position[i]);
    container.put(i, x[0], x[1], x[2], g.radius[i] / turned.unit);
  }
  std::vector<Corner> corners;
  voro::c_loop_all_periodic loop(container);
  voro::voronoicell cell;
  std::vector<double> vertices;
  if (!loop.start()) return corners;
  do {
    if (!container.compute_cell(cell, loop)) continue;
    const int i = loop.pid();
    volume[i] = cell.volume() * std::pow(turned.unit, 3);
    cell.vertices(vertices);  // positions of the vertices relative to the centre of the grain
    for (std::size_t v = 0; v + 2 < vertices.size(); v += 3) {
      const Vec<3> from = turned.here({vertices[v], vertices[v + 1], vertices[v + 2]});
      corners.push_back({packing.cell.wrapped(g.position[i] + from), from.norm() - g.radius[i]});
    }
  } while (loop.inc());
  return corners;
}

/// Merges vertices at the same place. Returns a ball about each merged vertex. Among the grains whose Voronoi cells
/// meet at the vertex, the ball touches the nearest.
std::vector<VoidBall> merged(const Packing<3>& packing, const std::vector<Corner>& corners) {
  Grains<3> points = Grains<3>::with_size(static_cast<int>(corners.size()));
  for (std::size_t k = 0; k < corners.size(); ++k) points.position[k] = corners[k].at;
  DisjointSets same(points.size());
  for (const NeighborPair<3>& pair :
       find_pairs(packing.cell, points, kSameVertex * largest_diameter(packing.grains)))
    same.join(pair.i, pair.j);
  std::vector<double> radius;
  for (const Corner& corner : corners) radius.push_back(corner.to_surface);
  for (int k = 0; k < points.size(); ++k) {
    double& nearest = radius[same.root(k)];
    nearest = std::min(nearest, corners[k].to_surface);
  }
  std::vector<VoidBall> voids;
  for (int k = 0; k < points.size(); ++k)
    if (same.root(k) == k && radius[k] > 0.0) voids.push_back({corners[k].at, radius[k]});
  return voids;
}

bool equal_sizes(const Grains<3>& grains) {
  const auto [least, most] = std::minmax_element(grains.radius.begin(), grains.radius.end());
  return *least == *most;
}

/// Reduces the radius of each ball so that the ball extends to the nearest surface of all grains. With unequal spheres,
/// the nearest grain may be a grain whose Voronoi cell does not contain the centre of the ball.
void shrink_to_nearest(const Packing<3>& packing, std::vector<VoidBall>& voids) {
  Grains<3> all = packing.grains;
  all.position_low.clear();
  for (const VoidBall& ball : voids) {
    all.position.push_back(ball.centre);
    all.radius.push_back(ball.radius);
  }
  const int n = packing.grains.size();
  for (const NeighborPair<3>& pair : find_pairs(packing.cell, all, 0.0)) {
    if (pair.i >= n || pair.j < n) continue;  // keep only pairs of a grain i and a ball j
    const Vec<3> r = all.position[pair.j] + packing.cell.shift(pair.image) - all.position[pair.i];
    double& radius = voids[pair.j - n].radius;
    radius = std::min(radius, r.norm() - all.radius[pair.i]);
  }
  std::erase_if(voids, [](const VoidBall& ball) { return ball.radius <= 0.0; });
}

}  // namespace

VoronoiTessellation voronoi_tessellation(const Packing<3>& packing) {
  assert(packing.grains.size() > 0 && packing.walls.empty());
  VoronoiTessellation out;
  out.volume.assign(packing.grains.size(), 0.0);
  out.voids = merged(packing, tessellate(packing, out.volume));
  if (!equal_sizes(packing.grains)) shrink_to_nearest(packing, out.voids);
  for (int i = 0; i < packing.grains.size(); ++i) {
    const double grain = 4.0 / 3.0 * std::numbers::pi * std::pow(packing.grains.radius[i], 3);
    out.solid_fraction.push_back(out.volume[i] > 0.0 ? grain / out.volume[i] : 0.0);
  }
  return out;
}

}  // namespace floc
