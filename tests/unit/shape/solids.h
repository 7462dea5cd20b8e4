#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "floc/base/random.h"
#include "floc/shape/shape.h"

/// Vertices of solids with known volumes and moments of inertia, and random points.
namespace floc::test {

inline std::vector<Vec<3>> box_points(double x, double y, double z) {
  std::vector<Vec<3>> points;
  for (int k = 0; k < 8; ++k)
    points.emplace_back((k & 1 ? 0.5 : -0.5) * x, (k & 2 ? 0.5 : -0.5) * y, (k & 4 ? 0.5 : -0.5) * z);
  return points;
}

/// Regular tetrahedron with edges of sqrt(8), centred at the origin.
inline std::vector<Vec<3>> tetrahedron_points() {
  return {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
}

inline std::vector<Vec<3>> octahedron_points() {
  return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}

/// Regular icosahedron with edges of 2.
inline std::vector<Vec<3>> icosahedron_points() {
  std::vector<Vec<3>> points;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-std::numbers::phi, std::numbers::phi})
      points.emplace_back(0, a, b), points.emplace_back(a, b, 0), points.emplace_back(b, 0, a);
  return points;
}

/// Corners of a regular polygon on the unit circle, the first one at the top.
inline std::vector<Vec<2>> polygon_points(int n) {
  std::vector<Vec<2>> points;
  for (int k = 0; k < n; ++k) {
    const double angle = std::numbers::pi * (0.5 + 2.0 * k / n);
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return points;
}

template <int Dim>
Vec<Dim> random_direction(RandomStream& random) {
  Vec<Dim> u;
  for (int a = 0; a < Dim; ++a) u[a] = random.normal();
  return u.normalized();
}

inline Mat<3> random_turn(RandomStream& random, Vec<3>) {
  Eigen::Quaterniond q;
  for (int k = 0; k < 4; ++k) q.coeffs()[k] = random.normal();
  return q.normalized().toRotationMatrix();
}
inline Mat<2> random_turn(RandomStream& random, Vec<2>) {
  return Eigen::Rotation2Dd(random.uniform(0.0, 2.0 * std::numbers::pi)).toRotationMatrix();
}
template <int Dim>
Mat<Dim> random_turn(RandomStream& random) {
  return random_turn(random, Vec<Dim>());
}

/// Random points near a sphere; the faces of their hull have all directions.
template <int Dim>
std::vector<Vec<Dim>> random_points(RandomStream& random, int n) {
  std::vector<Vec<Dim>> points;
  for (int k = 0; k < n; ++k) {
    const double radius = random.uniform(0.8, 1.0);
    points.push_back(radius * random_direction<Dim>(random));
  }
  return points;
}

template <int Dim>
Shape<Dim> shape_of(const std::vector<Vec<Dim>>& points, double rounding = 0.0) {
  return shape_of_points<Dim>(points, rounding).shape;
}

}  // namespace floc::test
