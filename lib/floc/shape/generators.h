#pragma once

#include <cstdint>
#include <vector>

#include "floc/shape/shape.h"

namespace floc {

/// Generators of shapes of grains. All shapes have diameter 1 (of the circumscribed circle or sphere about the
/// centre of mass). The argument `rounding` is the radius of rounding as a fraction of the diameter, from 0 to
/// 0.45. A seed determines the sequence of shapes; a larger count continues the sequence.
///
/// They throw InputError with the key of the table grains.shape of a scene, its value and the values that are
/// allowed.

/// Returns a regular polygon with 3 to 200 sides.
Shape<2> regular_polygon(int sides, double rounding);

/// Returns a rectangle or cuboid. Only the proportions of its sides matter.
template <int Dim>
Shape<Dim> box(const Vec<Dim>& sides, double rounding);

/// Returns a capsule that is `aspect` times as long as it is thick, 1 to 20; if `aspect` is 1, a disk or
/// sphere.
template <int Dim>
Shape<Dim> capsule(double aspect);

/// Options of convex hulls of random points. The points lie on a sphere (in 2D on a circle), at mutual
/// distances of at least half the mean spacing sqrt(4 pi/n) (2 pi/n in 2D), and are stretched by `aspect` along
/// one axis.
struct HullOptions {
  int least_vertices = 12;
  int most_vertices = 24;
  double aspect = 1.4;

  std::vector<std::string> validate(int dim) const;
};
template <int Dim>
std::vector<Shape<Dim>> hull_shapes(const HullOptions& options, int count, double rounding, std::uint64_t seed);

/// Options of intersections of half-spaces n . x <= 1 + u. The offset u is uniform between -spread/2 and
/// spread/2, and the directions n are distributed like the points of hull_shapes().
struct CutOptions {
  int least_faces = 10;
  int most_faces = 20;
  double spread = 0.3;

  std::vector<std::string> validate(int dim) const;
};
template <int Dim>
std::vector<Shape<Dim>> cut_shapes(const CutOptions& options, int count, double rounding, std::uint64_t seed);

/// Options of Voronoi cells of random points in a periodic box. Before the cells are used, the points are moved
/// `relaxed` times to the centres of mass of their cells.
struct VoronoiOptions {
  int cells = 500;
  int relaxed = 2;

  std::vector<std::string> validate() const;
};
/// Returns Voronoi cells as shapes.
/// @param count  number of shapes, at most options.cells
template <int Dim>
std::vector<Shape<Dim>> voronoi_shapes(const VoronoiOptions& options, int count, double rounding,
                                       std::uint64_t seed);

}  // namespace floc
