#pragma once

#include <cstdint>
#include <vector>

#include "floc/shape/shape.h"

namespace floc {

/// Generators of shapes. All have diameter 1 (of the circumscribed circle or sphere about the centre of mass);
/// `rounding` is a share of the diameter, from 0 to 0.45. One seed gives one set of shapes, of which a larger
/// count gives more.
///
/// They throw InputError naming the key of a scene's grains.shape, its value and what was expected.

/// Regular polygon of 3 to 200 sides.
Shape<2> regular_polygon(int sides, double rounding);

/// Rectangle or cuboid; its sides matter up to a factor.
template <int Dim>
Shape<Dim> box(const Vec<Dim>& sides, double rounding);

/// Capsule `aspect` times as long as thick, 1 to 20; at 1 a disk or sphere.
template <int Dim>
Shape<Dim> capsule(double aspect);

/// Hulls of random points on a sphere (in 2D on a circle), at mutual distances of at least half the mean
/// spacing sqrt(4 pi/n) (2 pi/n), stretched by `aspect` along one axis.
struct HullOptions {
  int least_vertices = 12;
  int most_vertices = 24;
  double aspect = 1.4;

  std::vector<std::string> validate(int dim) const;
};
template <int Dim>
std::vector<Shape<Dim>> hull_shapes(const HullOptions& options, int count, double rounding, std::uint64_t seed);

/// Intersections of half-spaces n . x <= 1 + u, with u uniform in +-spread/2 and directions n as the points of
/// hull_shapes().
struct CutOptions {
  int least_faces = 10;
  int most_faces = 20;
  double spread = 0.3;

  std::vector<std::string> validate(int dim) const;
};
template <int Dim>
std::vector<Shape<Dim>> cut_shapes(const CutOptions& options, int count, double rounding, std::uint64_t seed);

/// Voronoi cells of random points in a periodic box, `relaxed` times moved to the centres of mass of their
/// cells.
struct VoronoiOptions {
  int cells = 500;
  int relaxed = 2;

  std::vector<std::string> validate() const;
};
/// @param count  at most options.cells
template <int Dim>
std::vector<Shape<Dim>> voronoi_shapes(const VoronoiOptions& options, int count, double rounding,
                                       std::uint64_t seed);

}  // namespace floc
