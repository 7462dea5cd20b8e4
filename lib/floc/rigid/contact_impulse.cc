#include "floc/rigid/contact_impulse.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace floc {
namespace {

/// Largest number of steps of an iteration. The iterations normally converge much earlier.
constexpr int kMostSteps = 100;

/// Returns the impulse that makes the relative velocity zero.
template <int Dim>
Vec<Dim> sticking_impulse(const ContactProblem<Dim>& problem) {
  return -problem.response.llt().solve(problem.velocity);
}

template <int Dim>
bool is_in_cone(const Vec<Dim>& impulse, double friction) {
  return impulse[0] >= 0.0 && impulse.template tail<Dim - 1>().norm() <= friction * impulse[0];
}

Vec<2> sliding_impulse(const ContactProblem<2>& problem, const Vec<2>& sticking) {
  const Mat<2>& a = problem.response;
  const double mu = problem.friction;
  const auto along = [&](double sign) {
    const double p = -problem.velocity[0] / (a(0, 0) + sign * mu * a(0, 1));
    return Vec<2>(p, sign * mu * p);
  };
  const double sign = sticking[1] > 0.0 ? 1.0 : -1.0;
  // If the response couples slip strongly to the normal velocity (as in a steep wedge), friction in one direction would
  // pull the bodies together. The impulse then has the other direction.
  return a(0, 0) + sign * mu * a(0, 1) > 0.0 ? along(sign) : along(-sign);
}

/// Tangential impulse p_t with |p_t| <= r that minimises the tangential velocity |A_t p + q_t| in the norm of A_tt^-1
/// (see ContactProblem). This trust-region problem is solved in the axes in which A_tt is diagonal.
struct Slip {
  Vec<2> eigenvalue;
  Mat<2> axes;

  explicit Slip(const Mat<2>& response) {
    Eigen::SelfAdjointEigenSolver<Mat<2>> solver;
    solver.computeDirect(response);
    eigenvalue = solver.eigenvalues();
    axes = solver.eigenvectors();
  }
  Vec<2> impulse(const Vec<2>& drive, double radius) const {
    const Vec<2> b = -axes.transpose() * drive;
    const auto at = [&](double shift) { return Vec<2>(b.array() / (eigenvalue.array() + shift)); };
    Vec<2> p = at(0.0);
    if (p.norm() <= radius) return axes * p;
    if (radius == 0.0) return Vec<2>::Zero();
    // Newton's method finds the shift of the eigenvalues at which 1/|p| = 1/radius. The iterates converge from one side
    // and do not overshoot the root.
    double shift = 0.0;
    for (int n = 0; n < kMostSteps; ++n) {
      const double size = p.norm();
      const double slope = -(p.array().square() / (eigenvalue.array() + shift)).sum() / size;
      const double change = size * (radius - size) / (radius * slope);
      shift += change;
      p = at(shift);
      if (change <= 1e-15 * (shift + eigenvalue[1])) break;
    }
    return axes * (p * (radius / p.norm()));
  }
};

Vec<3> sliding_impulse(const ContactProblem<3>& problem, const Vec<3>& /*sticking*/) {
  const Mat<3>& a = problem.response;
  const Vec<2> coupling = a.bottomLeftCorner<2, 1>(), slip = problem.velocity.tail<2>();
  const Slip friction(a.bottomRightCorner<2, 2>());
  const auto impulse_at = [&](double p) {
    Vec<3> out;
    out << p, friction.impulse(slip + coupling * p, problem.friction * p);
    return out;
  };
  const auto normal_velocity = [&](const Vec<3>& p) { return a.row(0).dot(p) + problem.velocity[0]; };
  // At P = 0 the bodies approach each other; at a large enough P they move apart. Between these two values of P, the
  // Illinois method (modified regula falsi) finds the P at which the normal velocity is zero.
  double low = 0.0, f_low = problem.velocity[0], high = -problem.velocity[0] / a(0, 0);
  Vec<3> p = impulse_at(high);
  double f_high = normal_velocity(p);
  for (int n = 0; n < kMostSteps && f_high < 0.0; ++n) {
    low = high;
    f_low = f_high;
    high *= 2.0;
    p = impulse_at(high);
    f_high = normal_velocity(p);
  }
  for (int n = 0; n < kMostSteps && f_high > 0.0 && high - low > 1e-15 * high; ++n) {
    const double middle = std::clamp((low * f_high - high * f_low) / (f_high - f_low), low, high);
    p = impulse_at(middle);
    const double f = normal_velocity(p);
    if (std::abs(f) <= 1e-15 * std::abs(problem.velocity[0])) break;
    if (f < 0.0) {
      low = middle;
      f_low = f;
      f_high *= 0.5;
    } else {
      high = middle;
      f_high = f;
      f_low *= 0.5;
    }
  }
  return p;
}

}  // namespace

template <int Dim>
Vec<Dim> contact_impulse(const ContactProblem<Dim>& problem) {
  if (problem.velocity[0] >= 0.0) return Vec<Dim>::Zero();
  const Vec<Dim> sticking = sticking_impulse(problem);
  if (is_in_cone(sticking, problem.friction)) return sticking;
  return sliding_impulse(problem, sticking);
}

template <int Dim>
double contact_error(const ContactProblem<Dim>& problem, const Vec<Dim>& impulse) {
  const Vec<Dim> velocity = problem.response * impulse + problem.velocity;
  const double normal = std::max(0.0, impulse[0] - velocity[0] / problem.response(0, 0));
  const Mat<Dim - 1> across = problem.response.template bottomRightCorner<Dim - 1, Dim - 1>();
  const double stiffness = across.trace() / (Dim - 1);
  Vec<Dim - 1> slip = impulse.template tail<Dim - 1>() - velocity.template tail<Dim - 1>() / stiffness;
  const double limit = problem.friction * std::max(0.0, impulse[0]), size = slip.norm();
  if (size > limit) slip *= limit / size;
  return std::max(std::abs(impulse[0] - normal), (impulse.template tail<Dim - 1>() - slip).norm());
}

template Vec<2> contact_impulse(const ContactProblem<2>&);
template Vec<3> contact_impulse(const ContactProblem<3>&);
template double contact_error(const ContactProblem<2>&, const Vec<2>&);
template double contact_error(const ContactProblem<3>&, const Vec<3>&);

}  // namespace floc
