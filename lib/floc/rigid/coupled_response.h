#pragma once

#include <Eigen/LU>
#include <cmath>

#include "floc/base/vec.h"

namespace floc {

/// Solves ContactProblem for one response A and many velocities q. All quantities that depend only on A are computed
/// once. The results agree with those of contact_impulse().
template <int Dim>
class CoupledResponse;

template <>
class CoupledResponse<2> {
 public:
  /// @param response  matrix A, symmetric and positive definite
  /// @param friction  friction coefficient mu >= 0
  CoupledResponse(const Mat<2>& response, double friction) : response_(response), friction_(friction) {
    stick_ = -response.inverse();
    const double nn = response(0, 0), nt = response(0, 1);
    for (const int up : {0, 1}) {
      double sign = up == 1 ? 1.0 : -1.0;
      // If friction in this direction would pull the bodies together, the impulse has the other direction.
      if (nn + sign * friction * nt <= 0.0) sign = -sign;
      slide_normal_[up] = -1.0 / (nn + sign * friction * nt);
      slide_tangent_[up] = sign * friction * slide_normal_[up];
    }
  }

  const Mat<2>& response() const { return response_; }
  double friction() const { return friction_; }
  Vec<2> times(const Vec<2>& impulse) const { return response_ * impulse; }

  /// Returns the impulse that solves the problem with velocity q. The function computes all cases and selects one
  /// without a branch, since processors cannot predict which contacts slide.
  Vec<2> impulse(const Vec<2>& q) const {
    const double stick_n = stick_(0, 0) * q[0] + stick_(0, 1) * q[1];
    const double stick_t = stick_(1, 0) * q[0] + stick_(1, 1) * q[1];
    const int up = stick_t > 0.0;
    const double slide_n = q[0] * slide_normal_[up], slide_t = q[0] * slide_tangent_[up];
    // `outside` is positive if the sticking impulse is outside Coulomb's cone. For q[0] >= 0, `outside` is not used.
    // For q[0] < 0, a negative stick_n occurs only together with stick_t != 0, and `outside` is then positive, too.
    const double outside = std::abs(stick_t) - friction_ * stick_n;
    const double p_n = outside > 0.0 ? slide_n : stick_n, p_t = outside > 0.0 ? slide_t : stick_t;
    return {q[0] < 0.0 ? p_n : 0.0, q[0] < 0.0 ? p_t : 0.0};
  }

 private:
  Mat<2> response_, stick_;
  double friction_;
  // impulse of a sliding contact divided by q[0], for a negative and a positive tangential impulse
  double slide_normal_[2], slide_tangent_[2];
};

/// Contact problem in 3D. The tangents are the axes in which A_tt is diagonal. In block form, A = (a, c'; c, diag(l)),
/// with a number a and vectors c and l.
///
/// An impulse with slip u_t = -s p_t, s >= 0, solves (A + diag(0, s, s)) p = -q. By Cramer's rule its components are P
/// = N_n(s)/D(s) and p_t = N_t(s)/D(s), where D is positive, N_n is quadratic and N_t is linear in s. A contact sticks
/// if s = 0. It slides if s is the root of h(s) = 1 with h = mu N_n/|N_t|. If A is isotropic in the tangents and does
/// not couple the tangents to the normal, h is linear in s. In other cases Newton's method usually finds the root in a
/// few steps, starting from the root of the previous call.
template <>
class CoupledResponse<3> {
 public:
  /// @param response  matrix A with diagonal A_tt (the other components of A_tt are not read)
  CoupledResponse(const Mat<3>& response, double friction)
      : normal_(response(0, 0)),
        coupling_(response(1, 0), response(2, 0)),
        tangential_(response(1, 1), response(2, 2)),
        friction_(friction) {
    inverse_determinant_ = 1.0 / determinant(0.0);
  }

  Mat<3> response() const {
    Mat<3> out = Mat<3>::Zero();
    out.diagonal() << normal_, tangential_;
    out.bottomLeftCorner<2, 1>() = coupling_;
    out.topRightCorner<1, 2>() = coupling_.transpose();
    return out;
  }
  double friction() const { return friction_; }
  Vec<3> times(const Vec<3>& p) const {
    return {normal_ * p[0] + coupling_[0] * p[1] + coupling_[1] * p[2],
            coupling_[0] * p[0] + tangential_[0] * p[1], coupling_[1] * p[0] + tangential_[1] * p[2]};
  }

  /// Returns the impulse that solves the problem with velocity q.
  Vec<3> impulse(const Vec<3>& q) {
    if (q[0] >= 0.0) return Vec<3>::Zero();
    const Numerators numerators(*this, q);
    const Vec<2> t = numerators.tangential(0.0);
    const double n = numerators.n0;
    if (n >= 0.0 && t.squaredNorm() <= friction_ * friction_ * n * n)
      return Vec<3>(n, t[0], t[1]) * inverse_determinant_;
    if (friction_ == 0.0) return {-q[0] / normal_, 0.0, 0.0};
    return sliding_impulse(q[0], numerators);
  }

 private:
  /// Numerators of the components of the impulse by Cramer's rule, as functions of s.
  struct Numerators {
    double n0, n1, n2;  // N_n = n0 + n1 s + n2 s^2
    double x0, x1;      // N_t = (x0 + x1 s, y0 + y1 s)
    double y0, y1;

    Numerators(const CoupledResponse& of, const Vec<3>& q) {
      const double c1 = of.coupling_[0], c2 = of.coupling_[1], l1 = of.tangential_[0], l2 = of.tangential_[1];
      n2 = -q[0];
      n1 = c1 * q[1] + c2 * q[2] + n2 * (l1 + l2);
      n0 = c1 * q[1] * l2 + c2 * q[2] * l1 + n2 * l1 * l2;
      x1 = c1 * q[0] - of.normal_ * q[1];
      y1 = c2 * q[0] - of.normal_ * q[2];
      const double turned = c2 * q[1] - c1 * q[2];
      x0 = x1 * l2 + c2 * turned;
      y0 = y1 * l1 - c1 * turned;
    }
    Vec<2> tangential(double s) const { return {x0 + x1 * s, y0 + y1 * s}; }
  };

  double determinant(double s) const {
    const double l1 = tangential_[0] + s, l2 = tangential_[1] + s;
    return normal_ * l1 * l2 - coupling_[0] * coupling_[0] * l2 - coupling_[1] * coupling_[1] * l1;
  }

  Vec<3> sliding_impulse(double q_n, const Numerators& of) {
    // The root lies between `low`, where the impulse is outside the cone, and `high`, where it is inside.
    double low = 0.0, high = kUnbounded, s = slip_;
    Vec<2> direction = Vec<2>::Zero();
    for (int n = 0; n < kMostSteps; ++n) {
      const Vec<2> t = of.tangential(s);
      const double inverse = 1.0 / t.norm();
      direction = t * inverse;
      const double h = friction_ * (of.n0 + s * (of.n1 + s * of.n2)) * inverse;
      const double slope = friction_ * (of.n1 + 2.0 * s * of.n2) * inverse -
                           h * (direction[0] * of.x1 + direction[1] * of.y1) * inverse;
      (h < 1.0 ? low : high) = s;
      double next = s + (1.0 - h) / slope;
      // If Newton's step leaves the interval or is not a number, the interval is halved; if the interval has no upper
      // end, s is doubled.
      if (!(next >= low && next <= high))
        next = high < kUnbounded ? 0.5 * (low + high) : 2.0 * s + tangential_[0];
      const double change = std::abs(next - s);
      s = next;
      // Newton's method converges quadratically: the remaining error is about the square of the last step.
      if (change <= kSmallStep * (s + tangential_[0])) break;
    }
    slip_ = s;
    direction = of.tangential(s);
    direction /= direction.norm();
    const double p = -q_n / (normal_ + friction_ * coupling_.dot(direction));
    return {p, friction_ * p * direction[0], friction_ * p * direction[1]};
  }

  static constexpr int kMostSteps = 100;
  static constexpr double kUnbounded = 1e300;
  static constexpr double kSmallStep = 1e-9;

  double normal_;
  Vec<2> coupling_, tangential_;
  double friction_;
  double inverse_determinant_;  // 1/D(0)
  double slip_ = 0.0;           // value of s in the last solution with slip
};

}  // namespace floc
