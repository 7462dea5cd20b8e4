#pragma once

#include <cstdint>
#include <vector>

#include "floc/shape/shape.h"

namespace floc {

/// Functions that generate shapes of grains. All shapes have the diameter 1; the diameter is that of the circumscribed
/// circle or sphere about the centre of mass. The argument `rounding` is the radius of rounding divided by the
/// diameter, from 0 to 0.45. The argument `seed` determines a sequence of random shapes. A larger `count` gives more
/// shapes of this sequence; the first shapes do not change.
///
/// If an argument is out of range, the functions throw InputError. The message has the key of the argument in the table
/// grains.shape of a scene file, the value, and the allowed values.

/// Returns a regular polygon with 3 to 200 sides.
Shape<2> regular_polygon(int sides, double rounding);

/// Returns a rectangle or cuboid. Only the proportions of its sides matter.
template <int Dim>
Shape<Dim> box(const Vec<Dim>& sides, double rounding);

/// Returns a capsule that is `aspect` times as long as it is thick, 1 <= `aspect` <= 20. If `aspect` is 1, the capsule
/// is a disk or sphere.
template <int Dim>
Shape<Dim> capsule(double aspect);

/// Options for shapes that are convex hulls of n random points. The points lie on the unit sphere (2D: unit circle).
/// Their mutual distances are at least half the mean spacing sqrt(4 pi/n) (2D: 2 pi/n). The points are then stretched
/// by the factor `aspect` along one axis.
struct HullOptions {
  int least_vertices = 12;
  int most_vertices = 24;
  double aspect = 1.4;

  std::vector<std::string> validate(int dim) const;
};
template <int Dim>
std::vector<Shape<Dim>> hull_shapes(const HullOptions& options, int count, double rounding, std::uint64_t seed);

/// Options for shapes that are intersections of half-spaces n . x <= 1 + u. The number u is uniformly distributed
/// between -spread/2 and spread/2. The unit vectors n are distributed like the points of HullOptions, but without the
/// stretching.
struct CutOptions {
  int least_faces = 10;
  int most_faces = 20;
  double spread = 0.3;

  std::vector<std::string> validate(int dim) const;
};
template <int Dim>
std::vector<Shape<Dim>> cut_shapes(const CutOptions& options, int count, double rounding, std::uint64_t seed);

/// Options for shapes that are the Voronoi cells of `cells` random points in a periodic box. Before the cells become
/// shapes, each point is moved `relaxed` times to the centre of mass of its present cell.
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
