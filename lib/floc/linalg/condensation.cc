#include "floc/linalg/condensation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "floc/base/dense_solvers.h"

namespace floc {
namespace {

template <class Real>
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Extended = Vector<long double>;

/// Bound on the relative rounding error of each entry in the matrices A and B of a SpringSystem. An entry is computed
/// by a few products, quotients and roots.
constexpr double kEntryRounding = 8.0 * std::numeric_limits<double>::epsilon();

template <class Real>
struct SpringForces {
  Vector<Real> force;  // force A^T k (A u + B e) on each free unknown
  Real energy;         // twice the energy: sum of k (A u + B e)^2
};

/// Computes the forces and the energy of the springs for displacements u of the free unknowns.
/// @param boundary  index of the boundary unknown that is displaced by 1; negative if none is displaced
template <class Real>
SpringForces<Real> spring_forces(const SpringSystem& s, const Vector<Real>& u, int boundary) {
  SpringForces<Real> out{Vector<Real>::Zero(s.on_free.cols()), 0};
  const int* start = s.on_free.outerIndexPtr();
  const int* column = s.on_free.innerIndexPtr();
  const double* a = s.on_free.valuePtr();
  for (Eigen::Index r = 0; r < s.on_free.rows(); ++r) {
    Real elongation = boundary < 0 ? 0.0 : s.on_boundary(r, boundary);
    for (int k = start[r]; k < start[r + 1]; ++k) elongation += a[k] * u[column[k]];
    const Real force = s.stiffness[r] * elongation;
    for (int k = start[r]; k < start[r + 1]; ++k) out.force[column[k]] += a[k] * force;
    out.energy += force * elongation;
  }
  return out;
}

/// Relaxes the free unknowns while one boundary unknown is displaced by 1. The method is preconditioned conjugate
/// gradients or, if the system is indefinite, iterative refinement.
template <class Real>
class Relaxation {
 public:
  Relaxation(const SpringSystem& springs, const ApproximateInverse& inverse, int boundary,
             const Eigen::MatrixXd& start)
      : springs_(springs),
        inverse_(inverse),
        boundary_(boundary),
        u_(Vector<Real>::Zero(springs.on_free.cols())) {
    balance();
    load_ = imbalance();
    if (start.size() > 0) u_ = start.col(boundary).template cast<Real>(), balance();
    direction_ = z_;
  }

  void run(const CondensationOptions& options) {
    int stalled = 0;
    double best_work = work_;
    Vector<Real> best = u_;
    for (; steps_ < options.max_steps && stalled < options.patience && !converged(options.tolerance);
         ++steps_) {
      if (!step()) break;
      stalled = work_ < 0.5 * best_work ? 0 : stalled + 1;
      if (work_ < best_work) best_work = work_, best = u_;
    }
    if (best_work < work_) u_ = best, balance();
  }

  const Vector<Real>& solution() const { return u_; }
  double imbalance() const { return r_.size() == 0 ? 0.0 : static_cast<double>(r_.cwiseAbs().maxCoeff()); }
  double load() const { return load_; }
  int steps() const { return steps_; }

  /// Returns an upper bound on r^T K^-1 r, with the residual force r and the stiffness matrix K. The product r^T K^-1 r
  /// is twice the energy that further relaxation would release.
  double excess() const {
    if (work_ == 0.0) return 0.0;
    if (inverse_.estimated_ratio) return work_ / estimated_ratio();
    return inverse_.definite ? work_ / inverse_.smallest_ratio : work_ * inverse_.inverse_norm;
  }

  /// Returns whether the energy that further relaxation would release is at most `tolerance` times the present energy.
  /// The result is false before the first step or, if `smallest_ratio` is estimated from the steps, before
  /// kStepsOfEstimate steps.
  bool converged(double tolerance) const {
    if (work_ == 0.0) return true;
    if (steps_ < (inverse_.estimated_ratio ? kStepsOfEstimate : 1)) return false;
    if (inverse_.estimated_ratio && work_ > tolerance * stiffness_) return false;
    const double left = std::isfinite(excess()) ? excess() : work_;
    return left <= tolerance * stiffness_;
  }

 private:
  /// After kStepsOfEstimate steps, the lowest Ritz value times kShareOfRitz is a safe estimate of the lowest eigenvalue
  /// of M^-1 K. The factor kShareOfRitz is needed because Ritz values approach the eigenvalue from above. In one case,
  /// the lowest Ritz value was 5 times too large after this number of steps.
  static constexpr int kStepsOfEstimate = 4;
  static constexpr double kShareOfRitz = 0.1;

  /// Returns an estimate of the lowest eigenvalue of the preconditioned matrix M^-1 K: the lowest Ritz value times
  /// kShareOfRitz, but at most 1. Before kStepsOfEstimate steps, the estimate is 0. The lowest Ritz value is the lowest
  /// eigenvalue of a tridiagonal matrix. The coefficients alpha and beta of the conjugate gradients give the entries of
  /// this matrix.
  double estimated_ratio() const {
    const auto n = static_cast<Eigen::Index>(alphas_.size());
    if (n < kStepsOfEstimate) return 0.0;
    Eigen::VectorXd diagonal(n), beside(n - 1);
    for (Eigen::Index k = 0; k < n; ++k) {
      diagonal[k] = 1.0 / alphas_[k] + (k > 0 ? betas_[k - 1] / alphas_[k - 1] : 0.0);
      if (k + 1 < n) beside[k] = std::sqrt(betas_[k]) / alphas_[k];
    }
    return std::clamp(kShareOfRitz * tridiagonal_eigenvalues(diagonal, beside)[0], 0.0, 1.0);
  }

  void balance() {
    const SpringForces<Real> forces = spring_forces<Real>(springs_, u_, boundary_);
    stiffness_ = static_cast<double>(std::abs(forces.energy));
    r_ = -forces.force;
    z_ = r_.size() == 0 ? r_ : inverse_.apply(r_.template cast<double>()).template cast<Real>();
    work_ = static_cast<double>(inverse_.definite ? std::abs(r_.dot(z_)) : r_.squaredNorm());
  }

  bool step() {
    Real alpha = Real(1);
    if (inverse_.definite) {
      const Real energy = spring_forces<Real>(springs_, direction_, -1).energy;
      if (!(energy > Real(0))) return false;
      alpha = direction_.dot(r_) / energy;
    }
    u_ += alpha * direction_;
    const Vector<Real> r = r_;
    const Real work = z_.dot(r_);
    balance();
    // The weight beta of the previous direction is computed by Polak and Ribiere's formula, because this formula
    // tolerates rounding errors in the product with the approximate inverse.
    const Real beta = inverse_.definite ? std::max(z_.dot(r_ - r) / work, Real(0)) : Real(0);
    direction_ = z_ + beta * direction_;
    alphas_.push_back(static_cast<double>(alpha));
    betas_.push_back(static_cast<double>(beta));
    return true;
  }

  const SpringSystem& springs_;
  const ApproximateInverse& inverse_;
  int boundary_;
  Vector<Real> u_, r_, z_, direction_;
  double stiffness_ = 0.0;  // diagonal entry of the condensed stiffness, from the present displacements
  double work_ = 0.0;       // r^T M^-1 r for the residual force r; |r|^2 for an indefinite system
  double load_ = 0.0;       // largest residual force at u = 0
  int steps_ = 0;
  std::vector<double> alphas_, betas_;  // coefficients alpha and beta of each step of the conjugate gradients
};

/// Computes the condensed stiffness S = (A U + B)^T k (A U + B) of a SpringSystem. Column j of U contains the relaxed
/// free unknowns for a displacement of boundary unknown j by 1; `u` is the list of these columns. The function also
/// computes a bound on the error of S that rounding errors of the entries of A and B cause.
void sum_energies(const SpringSystem& s, const std::vector<Extended>& u, Condensation& out) {
  const int n = static_cast<int>(u.size());
  Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> sum(n, n);
  sum.setZero();
  Extended elongation(n);
  Eigen::VectorXd rounding(n);
  // Errors of the relaxed unknowns U change S only in second order, but rounding errors of an assembled stiffness
  // matrix would change S in first order. S is therefore summed spring by spring, in extended precision.
  for (Eigen::Index r = 0; r < s.on_free.rows(); ++r) {
    // The terms of the elongation (A U + B)_r nearly cancel. The bound on the rounding error of the elongation is
    // therefore proportional to the sum of the absolute values of the terms.
    for (int b = 0; b < n; ++b) {
      elongation[b] = s.on_boundary(r, b);
      rounding[b] = std::abs(s.on_boundary(r, b));
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(s.on_free, r); it; ++it) {
        const long double term = it.value() * u[b][it.col()];
        elongation[b] += term;
        rounding[b] += static_cast<double>(std::abs(term));
      }
      rounding[b] *= kEntryRounding;
    }
    for (int b = 0; b < n; ++b)
      for (int c = 0; c < n; ++c) {
        sum(b, c) += s.stiffness[r] * elongation[b] * elongation[c];
        out.error(b, c) += std::abs(s.stiffness[r]) *
                           ((static_cast<double>(std::abs(elongation[b])) + rounding[b]) * rounding[c] +
                            rounding[b] * (static_cast<double>(std::abs(elongation[c])) + rounding[c]));
      }
  }
  out.stiffness = sum.cast<double>();
}

/// For each boundary unknown in turn, displaces this unknown by 1 and relaxes the free unknowns.
/// @param u       receives the relaxed free unknowns, one vector per boundary unknown
/// @param excess  receives, for each boundary unknown, sqrt(2 E), where E is the energy that further relaxation would
///                release
template <class Real>
void relax_each(const SpringSystem& springs, const ApproximateInverse& inverse,
                const CondensationOptions& options, std::vector<Extended>& u, Eigen::VectorXd& excess,
                Condensation& out) {
  for (int b = 0; b < static_cast<int>(excess.size()); ++b) {
    Relaxation<Real> relaxation(springs, inverse, b, options.start);
    relaxation.run(options);
    u.push_back(relaxation.solution().template cast<long double>());
    out.response.col(b) = u.back().cast<double>();
    out.imbalance = std::max(out.imbalance, relaxation.imbalance());
    out.load = std::max(out.load, relaxation.load());
    out.steps = std::max(out.steps, relaxation.steps());
    out.converged = out.converged && relaxation.converged(options.tolerance);
    excess[b] = std::sqrt(relaxation.excess());
  }
}

}  // namespace

Condensation condense(const SpringSystem& springs, const ApproximateInverse& inverse,
                      const CondensationOptions& options) {
  const int n = static_cast<int>(springs.on_boundary.cols());
  Condensation out;
  out.error = Eigen::MatrixXd::Zero(n, n);
  out.response.resize(springs.on_free.cols(), n);
  std::vector<Extended> u;
  Eigen::VectorXd excess(n);
  if (options.extended)
    relax_each<long double>(springs, inverse, options, u, excess, out);
  else
    relax_each<double>(springs, inverse, options, u, excess, out);
  sum_energies(springs, u, out);
  out.error += excess * excess.transpose();
  // The condensed stiffness itself is rounded to double precision.
  out.error += std::numeric_limits<double>::epsilon() * out.stiffness.cwiseAbs();
  return out;
}

}  // namespace floc
