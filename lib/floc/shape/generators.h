#pragma once

#include <cstdint>
#include <vector>

#include "floc/shape/shape.h"

namespace floc {

/// Functions that generate shapes of grains. All shapes have diameter 1 (diameter of the circumscribed circle or sphere
/// about the centre of mass). The argument `rounding` is the radius of rounding as a fraction of the diameter, from 0
/// to 0.45. The argument `seed` determines a sequence of random shapes; a larger `count` extends the sequence.
///
/// If an argument is not allowed, the functions throw InputError with the key of the argument in the table grains.shape
/// of a scene file, its value and the allowed values.

/// Returns a regular polygon with 3 to 200 sides.
Shape<2> regular_polygon(int sides, double rounding);

/// Returns a rectangle or cuboid. Only the proportions of its sides matter.
template <int Dim>
Shape<Dim> box(const Vec<Dim>& sides, double rounding);

/// Returns a capsule that is `aspect` times as long as it is thick, 1 <= `aspect` <= 20. For `aspect` = 1 it is a disk
/// or sphere.
template <int Dim>
Shape<Dim> capsule(double aspect);

/// Options for shapes that are convex hulls of n random points. The points lie on the unit sphere (in 2D the unit
/// circle), at mutual distances of at least half their mean spacing sqrt(4 pi/n) (2 pi/n in 2D). The set of points is
/// then stretched by the factor `aspect` along one axis.
struct HullOptions {
  int least_vertices = 12;
  int most_vertices = 24;
  double aspect = 1.4;

  std::vector<std::string> validate(int dim) const;
};
template <int Dim>
std::vector<Shape<Dim>> hull_shapes(const HullOptions& options, int count, double rounding, std::uint64_t seed);

/// Options for shapes that are intersections of half-spaces n . x <= 1 + u. The number u is uniformly distributed
/// between -spread/2 and spread/2. The unit vectors n are distributed like the unstretched points of HullOptions.
struct CutOptions {
  int least_faces = 10;
  int most_faces = 20;
  double spread = 0.3;

  std::vector<std::string> validate(int dim) const;
};
template <int Dim>
std::vector<Shape<Dim>> cut_shapes(const CutOptions& options, int count, double rounding, std::uint64_t seed);

/// Options for shapes that are the Voronoi cells of `cells` random points in a periodic box. Before the cells are
/// computed, each point is moved `relaxed` times to the centre of mass of its cell.
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
