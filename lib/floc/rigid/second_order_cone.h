#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/vec.h"

/// Operations on the second-order cone K = {x : |(x_1, x_2, ..)| <= x_0}, for the interior point method. K is equal to
/// its dual cone. Products are those of the Jordan algebra of K [AG2003].
namespace floc::cone {

/// Returns x_0 - |(x_1, ..)|, which is negative outside the cone.
template <int Dim>
double margin(const Vec<Dim>& x) {
  return x[0] - x.template tail<Dim - 1>().norm();
}

/// Returns x' J x with J = diag(1, -1, ..), which is positive inside the cone.
template <int Dim>
double determinant(const Vec<Dim>& x) {
  const double r = x.template tail<Dim - 1>().norm();
  return (x[0] - r) * (x[0] + r);
}

/// Returns the vector with the eigenvectors of v and the eigenvalues f(l_-), f(l_+), where l_- <= l_+ are the
/// eigenvalues of v.
template <int Dim>
Vec<Dim> of_eigenvalues(const Vec<Dim>& v, const auto& f) {
  const double r = v.template tail<Dim - 1>().norm();
  const double lower = f(v[0] - r), upper = f(v[0] + r);
  Vec<Dim> out = Vec<Dim>::Zero();
  out[0] = 0.5 * (lower + upper);
  if (r > 0.0) out.template tail<Dim - 1>() = 0.5 * (upper - lower) / r * v.template tail<Dim - 1>();
  return out;
}

/// Returns the Jordan product of two vectors.
template <int Dim>
Vec<Dim> product(const Vec<Dim>& a, const Vec<Dim>& b) {
  Vec<Dim> out;
  out[0] = a.dot(b);
  out.template tail<Dim - 1>() = a[0] * b.template tail<Dim - 1>() + b[0] * a.template tail<Dim - 1>();
  return out;
}

/// Returns the vector x for which product(a, x) = b.
/// @pre a lies inside the cone
template <int Dim>
Vec<Dim> quotient(const Vec<Dim>& a, const Vec<Dim>& b) {
  const auto a1 = a.template tail<Dim - 1>();
  const auto b1 = b.template tail<Dim - 1>();
  Vec<Dim> x;
  x[0] = (a[0] * b[0] - a1.dot(b1)) / determinant<Dim>(a);
  x.template tail<Dim - 1>() = (b1 - x[0] * a1) / a[0];
  return x;
}

/// Scaling of Nesterov and Todd ([AG2003], section 7): the symmetric matrix W with W z = W^-1 x. W is stored as
/// eigenvectors and eigenvalues, because the eigenvalues differ by many orders of magnitude if x and z are close to the
/// surface of the cone.
template <int Dim>
struct Scaling {
  Mat<Dim> basis;  ///< eigenvectors of W, as columns
  Vec<Dim> eigenvalue;

  /// @pre x and z lie inside the cone
  Scaling(const Vec<Dim>& x, const Vec<Dim>& z) {
    const double det_x = determinant<Dim>(x), det_z = determinant<Dim>(z);
    const Vec<Dim> unit_x = x / std::sqrt(det_x), unit_z = z / std::sqrt(det_z);
    // W corresponds to a point of the hyperboloid det = 1. Only the last components of the point are computed; the
    // first follows from det = 1, so that rounding errors do not move the point away from the hyperboloid.
    const double gamma = std::sqrt(0.5 * (1.0 + unit_x.dot(unit_z)));
    const Vec<Dim - 1> side =
        (unit_x.template tail<Dim - 1>() - unit_z.template tail<Dim - 1>()) / (2.0 * gamma);
    const double length = side.norm();
    const Vec<Dim - 1> direction = length > 0.0 ? Vec<Dim - 1>(side / length) : Vec<Dim - 1>::Unit(0);
    const double stretch = length + std::sqrt(1.0 + length * length);
    const double size = std::sqrt(std::sqrt(det_x / det_z));
    basis.setZero();
    basis.row(0).template head<2>().setConstant(std::sqrt(0.5));
    basis.template bottomLeftCorner<Dim - 1, 1>() = std::sqrt(0.5) * direction;
    basis.col(1).template tail<Dim - 1>() = -std::sqrt(0.5) * direction;
    eigenvalue[0] = size * stretch;
    eigenvalue[1] = size / stretch;
    if constexpr (Dim == 3) {
      basis.col(2) << 0.0, -direction[1], direction[0];
      eigenvalue[2] = size;
    }
  }

  /// Returns W v.
  Vec<Dim> scaled(const Vec<Dim>& v) const { return basis * eigenvalue.cwiseProduct(basis.transpose() * v); }
  /// Returns W^-1 v.
  Vec<Dim> unscaled(const Vec<Dim>& v) const {
    return basis * (basis.transpose() * v).cwiseQuotient(eigenvalue);
  }

  /// Returns (Q + W^-2)^-1 for a diagonal Q >= 0. The function factorizes 1 + D Q' D, where D has the eigenvalues of W
  /// and Q' is the matrix Q in the basis of the eigenvectors. Small entries then keep all their digits.
  Mat<Dim> flexibility(const Vec<Dim>& diagonal) const {
    const Mat<Dim> stretch = eigenvalue.asDiagonal() * basis.transpose();
    const Mat<Dim> middle = Mat<Dim>::Identity() + stretch * diagonal.asDiagonal() * stretch.transpose();
    const Mat<Dim> root = middle.llt().matrixL().solve(stretch);
    return root.transpose() * root;
  }
};

/// Returns the largest number a for which x + a dx lies in the cone; infinite if there is no limit.
/// @pre x lies inside the cone
template <int Dim>
double longest_step(const Vec<Dim>& x, const Vec<Dim>& dx) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto x1 = x.template tail<Dim - 1>();
  const auto dx1 = dx.template tail<Dim - 1>();
  // The step is a root of det(x + a dx) = c + 2 b a + q a^2.
  const double q = determinant<Dim>(dx), b = x[0] * dx[0] - x1.dot(dx1), c = determinant<Dim>(x);
  const double d = b * b - q * c;
  double step = dx[0] < 0.0 ? -x[0] / dx[0] : kInfinity;
  if (d < 0.0 || (q > 0.0 && b > 0.0)) return step;
  const double t = b >= 0.0 ? -b - std::sqrt(d) : -b + std::sqrt(d);
  for (const double root : {c / t, t / q})
    if (root >= 0.0) step = std::min(step, root);
  return step;
}

}  // namespace floc::cone
