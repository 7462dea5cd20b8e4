#include "floc/geometry/ball_in_box.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floc {
namespace {

/// Returns the area of the part x > p, y > q of the unit disk, where (p, q) is the point t.
/// @param t  point inside the disk, with coordinates >= 0
double beyond_corner(const Vec<2>& t) {
  const double p = t[0], q = t[1];
  return p * q + 0.5 * (std::acos(p) - std::asin(q) - p * std::sqrt(1.0 - p * p) - q * std::sqrt(1.0 - q * q));
}

/// Returns the volume of the part x > a, y > b, z > c of the unit ball, where (a, b, c) is the point t.
/// @param t  point inside the ball, with coordinates >= 0
double beyond_corner(const Vec<3>& t) {
  double sphere = 2.0 * std::numbers::pi, faces = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    const double rho = std::sqrt(1.0 - a * a);
    // The plane x = a cuts the sphere along an arc. By the Gauss-Bonnet theorem, the area of the spherical face is 2 pi
    // minus two terms for each of its three arcs: the integral of the geodesic curvature along the arc, and the
    // exterior angle of the face at one end of the arc (here the end on the plane y = b).
    sphere -= a * (std::acos(std::min(1.0, b / rho)) - std::asin(std::min(1.0, c / rho)));
    sphere -= std::acos(std::max(-1.0, -a * b / (rho * std::sqrt(1.0 - b * b))));
    faces += a * rho * rho * beyond_corner(Vec<2>(std::min(1.0, b / rho), std::min(1.0, c / rho)));
  }
  return (sphere - faces) / 3.0;
}

/// Returns the area (2D) or volume (3D) of the part of the unit disk or ball with x_a > t_a along every axis a.
/// @param axis  first axis a for which t_a may be negative
template <int Dim>
double beyond(Vec<Dim> t, int axis = 0) {
  for (; axis < Dim; ++axis) {
    if (t[axis] >= 0.0) continue;
    // Let x be the coordinate along `axis`, and t < 0 its bound. The part with x > t is the part with any x minus the
    // part with x < t. The part with x < t is the mirror image of the part with x > -t. The part with any x is twice
    // the part with x > 0.
    Vec<Dim> mirrored = t;
    mirrored[axis] = -t[axis];
    t[axis] = 0.0;
    return 2.0 * beyond<Dim>(t, axis + 1) - beyond<Dim>(mirrored, axis + 1);
  }
  return t.squaredNorm() < 1.0 ? beyond_corner(t) : 0.0;
}

}  // namespace

template <int Dim>
double ball_in_box(const Vec<Dim>& centre, double radius, const Vec<Dim>& low, const Vec<Dim>& high) {
  const Vec<Dim> from = (low - centre) / radius, to = (high - centre) / radius;
  const double unit = std::pow(radius, Dim);
  const double whole = Dim == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi;
  if ((from.array() <= -1.0).all() && (to.array() >= 1.0).all()) return whole * unit;
  if ((from.array() >= 1.0).any() || (to.array() <= -1.0).any()) return 0.0;
  double sum = 0.0;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    Vec<Dim> t;
    double sign = 1.0;
    for (int a = 0; a < Dim; ++a) {
      const bool upper = (corner >> a & 1) != 0;
      t[a] = std::clamp(upper ? to[a] : from[a], -1.0, 1.0);
      if (upper) sign = -sign;
    }
    sum += sign * beyond<Dim>(t);
  }
  return std::clamp(sum, 0.0, whole) * unit;
}

template double ball_in_box(const Vec<2>&, double, const Vec<2>&, const Vec<2>&);
template double ball_in_box(const Vec<3>&, double, const Vec<3>&, const Vec<3>&);

}  // namespace floc
