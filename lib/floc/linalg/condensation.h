#pragma once

#include <Eigen/SparseCore>
#include <functional>

namespace floc {

/// Springs between free unknowns u and boundary unknowns e, of energy 1/2 sum_r k_r (A u + B e)_r^2.
struct SpringSystem {
  Eigen::SparseMatrix<double, Eigen::RowMajor> on_free;                                ///< A: a row per spring
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> on_boundary;  ///< B
  Eigen::VectorXd stiffness;  ///< k; negative ones are allowed
};

/// An approximation of the inverse of K = A^T k A, with bounds on its quality.
struct ApproximateInverse {
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> apply;  ///< M^-1 b
  /// K and M are positive semidefinite: the refinement minimises the energy by conjugate gradients.
  bool definite = true;
  /// If definite: lower bound on the non-zero eigenvalues of M^-1 K. 0 if it is unknown; there is then no error
  /// bound.
  double smallest_ratio = 0.0;
  /// If definite and `smallest_ratio` is unknown: whether to take it from the Ritz values of the refinement,
  /// which makes the error an estimate. Ritz values and error may miss a soft motion that the loads hardly
  /// excite.
  bool estimated_ratio = false;
  /// If not definite: upper bound on the 2-norm of K^-1; infinite if it is unknown.
  double inverse_norm = 0.0;
};

struct CondensationOptions {
  double tolerance = 1e-10;  ///< relative tolerance on the diagonal of the condensed stiffness
  /// Largest number of refinement steps; a good inverse takes one, and one more for each near-mechanism that it
  /// misses.
  int max_steps = 100;
  bool extended = true;  ///< residuals in extended precision; in double they are several times faster
  int patience = 5;      ///< steps without gain after which the refinement has reached rounding
  /// u to start from, one column per boundary unknown, such as the response of a nearby state; empty: u = 0.
  Eigen::MatrixXd start = {};
};

/// The stiffness of the boundary once the free unknowns have relaxed (Schur complement).
struct Condensation {
  Eigen::MatrixXd stiffness;  ///< S: 1/2 e^T S e = min over u of the energy; its stationary value if indefinite
  Eigen::MatrixXd error;      ///< bound on |S - exact|, entry by entry; infinite where none can be given
  Eigen::MatrixXd response;   ///< u for a unit of each boundary unknown
  double imbalance = 0.0;     ///< largest |A^T k (A u + B e)| over all unknowns and columns
  double load = 0.0;          ///< largest |A^T k B e| over all unknowns and columns: the imbalance at u = 0
  int steps = 0;              ///< steps of refinement that the worst column took
  bool converged = true;      ///< whether the bound or estimate of the error reached the tolerance
};

/// Computes the static condensation with residuals in extended precision, summed spring by spring, so that the
/// rounding of an assembled K or of its factor does not enter the result: it only slows the refinement.
///
/// The error bound has two parts. The energy still to be relaxed is exactly r^T K^-1 r for the imbalance r,
/// bounded by r^T M^-1 r over `smallest_ratio` (or |r|^2 |K^-1|). Rounding of the entries of A and B, taken as
/// a few units in the last place, changes the energy by its derivative with respect to them at fixed u (and by
/// the square of the change of each spring's elongation); no condition number enters.
[[nodiscard]] Condensation condense(const SpringSystem& springs, const ApproximateInverse& inverse,
                                    const CondensationOptions& options);

}  // namespace floc
