#pragma once

#include <Eigen/LU>
#include <cmath>

#include "floc/base/lanes.h"
#include "floc/base/vec.h"

namespace floc {

/// Solves ContactProblem for one response A and many velocities q. All quantities that depend only on A are computed
/// once. The results agree with those of contact_impulse(). The number type T is double, or a pack of several contacts
/// that are solved side by side (base/pack.h).
template <int Dim, class T = double>
class CoupledResponse;

template <class T>
class CoupledResponse<2, T> {
 public:
  static constexpr int kNumbers = 11;  ///< number of values that visit() visits

  CoupledResponse() = default;
  /// @param response  matrix A, symmetric and positive definite
  /// @param friction  friction coefficient mu >= 0
  CoupledResponse(const Mat<2>& response, double friction)
      : nn_(response(0, 0)), nt_(response(0, 1)), tt_(response(1, 1)), friction_(friction) {
    const Mat<2> stick = -response.inverse();
    stick_nn_ = stick(0, 0), stick_nt_ = stick(0, 1), stick_tt_ = stick(1, 1);
    for (const int up : {0, 1}) {
      double sign = up == 1 ? 1.0 : -1.0;
      // If friction in this direction would pull the bodies together, the impulse has the other direction.
      if (nn_ + sign * friction * nt_ <= 0.0) sign = -sign;
      slide_normal_[up] = -1.0 / (nn_ + sign * friction * nt_);
      slide_tangent_[up] = sign * friction * slide_normal_[up];
    }
  }

  /// Calls visit(value) for every stored value.
  template <class Visit>
  void visit(const Visit& visit) {
    visit(nn_);
    visit(nt_);
    visit(tt_);
    visit(friction_);
    visit(stick_nn_);
    visit(stick_nt_);
    visit(stick_tt_);
    visit(slide_normal_[0]);
    visit(slide_normal_[1]);
    visit(slide_tangent_[0]);
    visit(slide_tangent_[1]);
  }

  const T& normal() const { return nn_; }      ///< component A_nn
  const T& tangential() const { return tt_; }  ///< mean of the diagonal of A_tt
  const T& friction() const { return friction_; }
  /// Returns the product A p.
  Vec<2, T> times(const Vec<2, T>& p) const { return {nn_ * p[0] + nt_ * p[1], nt_ * p[0] + tt_ * p[1]}; }

  /// Returns the impulse that solves the problem with velocity q. The function computes all cases and selects one
  /// without a branch, since processors cannot predict which contacts slide.
  Vec<2, T> impulse(const Vec<2, T>& q) const {
    const T stick_n = stick_nn_ * q[0] + stick_nt_ * q[1];
    const T stick_t = stick_nt_ * q[0] + stick_tt_ * q[1];
    const auto up = T(0.0) < stick_t;
    const T slide_n = q[0] * lanes::select(up, slide_normal_[1], slide_normal_[0]);
    const T slide_t = q[0] * lanes::select(up, slide_tangent_[1], slide_tangent_[0]);
    // `outside` is positive if the sticking impulse is outside Coulomb's cone. For q[0] >= 0, `outside` is not used.
    // For q[0] < 0, a negative stick_n occurs only together with stick_t != 0, and `outside` is then positive, too.
    const auto slides = T(0.0) < lanes::absolute(stick_t) - friction_ * stick_n;
    const auto closed = q[0] < T(0.0);
    return {lanes::select(closed, lanes::select(slides, slide_n, stick_n), T(0.0)),
            lanes::select(closed, lanes::select(slides, slide_t, stick_t), T(0.0))};
  }

 private:
  T nn_, nt_, tt_, friction_;
  T stick_nn_, stick_nt_, stick_tt_;  // -A^-1
  // impulse of a sliding contact divided by q[0], for a negative and a positive tangential impulse
  T slide_normal_[2], slide_tangent_[2];
};

/// Contact problem in 3D. The tangents are the axes in which A_tt is diagonal. In block form, A = (a, c'; c, diag(l)),
/// with a number a and vectors c and l.
///
/// An impulse with slip u_t = -s p_t, s >= 0, solves (A + diag(0, s, s)) p = -q. By Cramer's rule its components are P
/// = N_n(s)/D(s) and p_t = N_t(s)/D(s), where D is positive, N_n is quadratic and N_t is linear in s. A contact sticks
/// if s = 0. It slides if s is the root of h(s) = 1 with h = mu N_n/|N_t|. If A is isotropic in the tangents and does
/// not couple the tangents to the normal, h is linear in s. In other cases Newton's method usually finds the root in a
/// few steps, starting from the root of the previous call.
template <class T>
class CoupledResponse<3, T> {
 public:
  static constexpr int kNumbers = 8;  ///< number of values that visit() visits

  CoupledResponse() = default;
  /// @param response  matrix A with diagonal A_tt (the other components of A_tt are not read)
  CoupledResponse(const Mat<3>& response, double friction)
      : normal_(response(0, 0)),
        coupling_(response(1, 0), response(2, 0)),
        tangential_(response(1, 1), response(2, 2)),
        friction_(friction) {
    inverse_determinant_ = 1.0 / determinant(0.0);
  }

  /// Calls visit(value) for every stored value. impulse() changes only the last of them.
  template <class Visit>
  void visit(const Visit& visit) {
    visit(normal_);
    visit(coupling_[0]);
    visit(coupling_[1]);
    visit(tangential_[0]);
    visit(tangential_[1]);
    visit(friction_);
    visit(inverse_determinant_);
    visit(slip_);
  }

  const T& normal() const { return normal_; }                                  ///< component A_nn
  T tangential() const { return T(0.5) * (tangential_[0] + tangential_[1]); }  ///< mean of the diagonal of A_tt
  const T& friction() const { return friction_; }
  /// Returns the product A p.
  Vec<3, T> times(const Vec<3, T>& p) const {
    return {normal_ * p[0] + coupling_[0] * p[1] + coupling_[1] * p[2],
            coupling_[0] * p[0] + tangential_[0] * p[1], coupling_[1] * p[0] + tangential_[1] * p[2]};
  }

  /// Returns the impulse that solves the problem with velocity q.
  Vec<3, T> impulse(const Vec<3, T>& q) {
    const Mask closed = q[0] < T(0.0);
    if (!lanes::any_lane(closed)) return zero();
    const Numerators numerators(*this, q);
    const Vec<2, T> t = numerators.tangential(T(0.0));
    const T n = numerators.n0;
    const Mask sticks = (T(0.0) <= n) & (t.squaredNorm() <= friction_ * friction_ * n * n);
    const Mask slides = closed & !sticks;
    Vec<3, T> p = chosen(
        closed, Vec<3, T>(n * inverse_determinant_, t[0] * inverse_determinant_, t[1] * inverse_determinant_),
        zero());
    const Mask rubs = slides & (T(0.0) < friction_), smooth = slides & !rubs;
    if (lanes::any_lane(smooth)) p = chosen(smooth, Vec<3, T>(-q[0] / normal_, T(0.0), T(0.0)), p);
    if (lanes::any_lane(rubs)) p = chosen(rubs, sliding_impulse(q[0], numerators, rubs), p);
    return p;
  }

 private:
  using Mask = std::remove_cvref_t<decltype(std::declval<T>() < std::declval<T>())>;

  /// Numerators of the components of the impulse by Cramer's rule, as functions of s.
  struct Numerators {
    T n0, n1, n2;  // N_n = n0 + n1 s + n2 s^2
    T x0, x1;      // N_t = (x0 + x1 s, y0 + y1 s)
    T y0, y1;

    Numerators(const CoupledResponse& of, const Vec<3, T>& q) {
      const T c1 = of.coupling_[0], c2 = of.coupling_[1], l1 = of.tangential_[0], l2 = of.tangential_[1];
      n2 = -q[0];
      n1 = c1 * q[1] + c2 * q[2] + n2 * (l1 + l2);
      n0 = c1 * q[1] * l2 + c2 * q[2] * l1 + n2 * l1 * l2;
      x1 = c1 * q[0] - of.normal_ * q[1];
      y1 = c2 * q[0] - of.normal_ * q[2];
      const T turned = c2 * q[1] - c1 * q[2];
      x0 = x1 * l2 + c2 * turned;
      y0 = y1 * l1 - c1 * turned;
    }
    Vec<2, T> tangential(const T& s) const { return {x0 + x1 * s, y0 + y1 * s}; }
  };

  static Vec<3, T> zero() { return {T(0.0), T(0.0), T(0.0)}; }
  static Vec<3, T> chosen(const Mask& when, const Vec<3, T>& a, const Vec<3, T>& b) {
    return {lanes::select(when, a[0], b[0]), lanes::select(when, a[1], b[1]), lanes::select(when, a[2], b[2])};
  }

  T determinant(const T& s) const {
    const T l1 = tangential_[0] + s, l2 = tangential_[1] + s;
    return normal_ * l1 * l2 - coupling_[0] * coupling_[0] * l2 - coupling_[1] * coupling_[1] * l1;
  }

  /// Returns the impulses of the contacts that slide, those of the mask `moves`.
  Vec<3, T> sliding_impulse(const T& q_n, const Numerators& of, const Mask& moves) {
    using std::sqrt;
    // The root lies between `low`, where the impulse is outside the cone, and `high`, where it is inside.
    T low(0.0), high(kUnbounded), s = slip_;
    Mask unfinished = moves;
    for (int n = 0; n < kMostSteps && lanes::any_lane(unfinished); ++n) {
      // With A = mu N_n, r = |N_t| and D = N_t . N_t', Newton's step (1 - h)/h' for h = A/r is (r - A) r^2/(A' r^2 - A
      // D). In this form, the square root and the division do not wait for each other.
      const Vec<2, T> t = of.tangential(s);
      const T square = t.squaredNorm(), size = sqrt(square);
      const T limit = friction_ * (of.n0 + s * (of.n1 + s * of.n2));
      const T slope = friction_ * (of.n1 + T(2.0) * s * of.n2) * square - limit * (t[0] * of.x1 + t[1] * of.y1);
      const Mask outside = limit < size;
      low = lanes::select(outside, s, low);
      high = lanes::select(outside, high, s);
      const T newton = s + (size - limit) * (square / slope);
      // If Newton's step leaves the interval or is not a number, the interval is halved; if the interval has no upper
      // end, s is doubled.
      const T otherwise =
          lanes::select(high < T(kUnbounded), T(T(0.5) * (low + high)), T(T(2.0) * s + tangential_[0]));
      const T next = lanes::select(Mask((low <= newton) & (newton <= high)), newton, otherwise);
      const T change = lanes::absolute(T(next - s));
      s = lanes::select(unfinished, next, s);
      // Newton's method converges quadratically: the remaining error is about the square of the last step.
      unfinished = unfinished & !(change <= T(kSmallStep) * (s + tangential_[0]));
    }
    slip_ = lanes::select(moves, s, slip_);
    // p_t = mu P t/|t|, and P follows from the normal component of A p + q = 0.
    const Vec<2, T> t = of.tangential(s);
    const T size = sqrt(t.squaredNorm());
    const T factor = -q_n / (normal_ * size + friction_ * (coupling_[0] * t[0] + coupling_[1] * t[1]));
    return {factor * size, friction_ * factor * t[0], friction_ * factor * t[1]};
  }

  static constexpr int kMostSteps = 100;
  static constexpr double kUnbounded = 1e300;
  static constexpr double kSmallStep = 1e-9;

  T normal_;
  Vec<2, T> coupling_, tangential_;
  T friction_;
  T inverse_determinant_;  // 1/D(0)
  T slip_ = T(0.0);        // value of s in the last solution with slip
};

}  // namespace floc
