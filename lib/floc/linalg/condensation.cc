#include "floc/linalg/condensation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace floc {
namespace {

using Extended = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// Relative rounding of an entry of A or B: the few products, quotients and roots that made it.
constexpr double kEntryRounding = 8.0 * std::numeric_limits<double>::epsilon();

struct Pull {
  Extended force;      // A^T k (A u + B e)
  long double energy;  // sum of k (A u + B e)^2
};

/// Forces that pull at the free unknowns displaced by u, for e the unit of one boundary unknown, or e = 0 if negative.
Pull pull(const SpringSystem& s, const Extended& u, int boundary) {
  Pull out{Extended::Zero(s.on_free.cols()), 0.0L};
  const int* start = s.on_free.outerIndexPtr();
  const int* column = s.on_free.innerIndexPtr();
  const double* a = s.on_free.valuePtr();
  for (Eigen::Index r = 0; r < s.on_free.rows(); ++r) {
    long double elongation = boundary < 0 ? 0.0 : s.on_boundary(r, boundary);
    for (int k = start[r]; k < start[r + 1]; ++k) elongation += a[k] * u[column[k]];
    const long double force = s.stiffness[r] * elongation;
    for (int k = start[r]; k < start[r + 1]; ++k) out.force[column[k]] += a[k] * force;
    out.energy += force * elongation;
  }
  return out;
}

/// Relaxes the free unknowns for one boundary unknown: preconditioned conjugate gradients, or plain refinement of an
/// indefinite system.
class Relaxation {
 public:
  Relaxation(const SpringSystem& springs, const ApproximateInverse& inverse, int boundary)
      : springs_(springs), inverse_(inverse), boundary_(boundary), u_(Extended::Zero(springs.on_free.cols())) {
    balance();
    direction_ = z_;
    load_ = imbalance();
  }

  void run(const CondensationOptions& options) {
    constexpr int kPatience = 5;  // steps without gain before rounding is said to be reached
    int idle = 0;
    double best_work = work_;
    Extended best = u_;
    for (; steps_ < options.max_steps && idle < kPatience && !converged(options.tolerance); ++steps_) {
      if (!step()) break;
      idle = work_ < 0.5 * best_work ? 0 : idle + 1;
      if (work_ < best_work) best_work = work_, best = u_;
    }
    if (best_work < work_) u_ = best, balance();
  }

  const Extended& solution() const { return u_; }
  double imbalance() const { return r_.size() == 0 ? 0.0 : static_cast<double>(r_.cwiseAbs().maxCoeff()); }
  double load() const { return load_; }
  int steps() const { return steps_; }

  /// Bound of r^T K^-1 r, the energy still to be gained.
  double excess() const {
    if (work_ == 0.0) return 0.0;
    return inverse_.definite ? work_ / inverse_.smallest_ratio : work_ * inverse_.inverse_norm;
  }

 private:
  /// At least one step, so that what a crude inverse gives is refined once.
  bool converged(double tolerance) const {
    const double left = std::isfinite(excess()) ? excess() : work_;
    return work_ == 0.0 || (steps_ > 0 && left <= tolerance * stiffness_);
  }

  void balance() {
    const Pull pulled = pull(springs_, u_, boundary_);
    stiffness_ = static_cast<double>(std::abs(pulled.energy));
    r_ = -pulled.force;
    z_ = r_.size() == 0 ? r_ : inverse_.apply(r_.cast<double>()).cast<long double>();
    work_ = static_cast<double>(inverse_.definite ? std::abs(r_.dot(z_)) : r_.squaredNorm());
  }

  bool step() {
    long double length = 1.0L;
    if (inverse_.definite) {
      const long double energy = pull(springs_, direction_, -1).energy;
      if (!(energy > 0.0L)) return false;
      length = direction_.dot(r_) / energy;
    }
    u_ += length * direction_;
    const Extended r = r_;
    const long double work = z_.dot(r_);
    balance();
    // Polak and Ribiere: the inverse is applied with rounding errors of its own.
    const long double turn = inverse_.definite ? z_.dot(r_ - r) / work : 0.0L;
    direction_ = z_ + (turn > 0.0L ? turn : 0.0L) * direction_;
    return true;
  }

  const SpringSystem& springs_;
  const ApproximateInverse& inverse_;
  int boundary_;
  Extended u_, r_, z_, direction_;
  double stiffness_ = 0.0;  // the diagonal entry of S at u
  double work_ = 0.0;       // r^T M^-1 r, or |r|^2 of an indefinite system
  double load_ = 0.0;       // imbalance at u = 0
  int steps_ = 0;
};

/// S = (A U + B)^T k (A U + B), and what rounding of the entries of A and B can do to it.
void sum_energies(const SpringSystem& s, const std::vector<Extended>& u, Condensation& out) {
  const int n = static_cast<int>(u.size());
  Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> sum(n, n);
  sum.setZero();
  Extended elongation(n);
  Eigen::VectorXd rounding(n);
  for (Eigen::Index r = 0; r < s.on_free.rows(); ++r) {
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

}  // namespace

Condensation condense(const SpringSystem& springs, const ApproximateInverse& inverse,
                      const CondensationOptions& options) {
  const int n = static_cast<int>(springs.on_boundary.cols());
  Condensation out;
  out.error = Eigen::MatrixXd::Zero(n, n);
  out.response.resize(springs.on_free.cols(), n);
  std::vector<Extended> u;
  Eigen::VectorXd excess(n);
  for (int b = 0; b < n; ++b) {
    Relaxation relaxation(springs, inverse, b);
    relaxation.run(options);
    u.push_back(relaxation.solution());
    out.response.col(b) = u.back().cast<double>();
    out.imbalance = std::max(out.imbalance, relaxation.imbalance());
    out.load = std::max(out.load, relaxation.load());
    out.steps = std::max(out.steps, relaxation.steps());
    excess[b] = std::sqrt(relaxation.excess());
  }
  sum_energies(springs, u, out);
  out.error += excess * excess.transpose();
  // Of the result itself.
  out.error += std::numeric_limits<double>::epsilon() * out.stiffness.cwiseAbs();
  return out;
}

}  // namespace floc
