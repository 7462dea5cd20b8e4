#pragma once

#include <Eigen/SparseCore>
#include <functional>

namespace floc {

/// System of springs between free unknowns u and boundary unknowns e, with the energy 1/2 sum_r k_r (A u + B e)_r^2.
struct SpringSystem {
  Eigen::SparseMatrix<double, Eigen::RowMajor> on_free;  ///< A: one row per spring, one column per free unknown
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
      on_boundary;            ///< B: one row per spring
  Eigen::VectorXd stiffness;  ///< k: stiffness of each spring; may be negative
};

/// Approximation M^-1 of the inverse of the stiffness matrix K = A^T k A of a SpringSystem, with bounds on its quality.
struct ApproximateInverse {
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> apply;  ///< returns M^-1 b for a vector b
  /// Whether K and M are positive semidefinite. The refinement then minimises the energy by conjugate gradients.
  bool definite = true;
  /// If `definite`: lower bound on the nonzero eigenvalues of M^-1 K. 0 if it is unknown; there is then no error bound.
  double smallest_ratio = 0.0;
  /// If `definite` and `smallest_ratio` is unknown: whether to estimate it from the Ritz values of the refinement, so
  /// that the error is an estimate. Ritz values and error may miss a soft motion that the loads hardly excite.
  bool estimated_ratio = false;
  /// If not `definite`: upper bound on the 2-norm of K^-1; infinite if it is unknown.
  double inverse_norm = 0.0;
};

struct CondensationOptions {
  double tolerance = 1e-10;  ///< relative tolerance on the diagonal entries of the condensed stiffness
  /// Largest number of refinement steps. A good approximate inverse needs one step, and one more for each
  /// near-mechanism that it does not resolve.
  int max_steps = 100;
  /// whether residuals are computed in extended precision; in double they are several times faster
  bool extended = true;
  int patience = 5;  ///< number of steps without progress after which the refinement has reached rounding
  /// Start values of u, one column per boundary unknown, for example the response of a nearby state; empty for u = 0.
  Eigen::MatrixXd start = {};
};

/// Result of static condensation: the stiffness of the boundary unknowns after relaxation of the free unknowns (Schur
/// complement).
struct Condensation {
  /// condensed stiffness S: 1/2 e^T S e is the minimum of the energy over u, or its stationary value if indefinite
  Eigen::MatrixXd stiffness;
  Eigen::MatrixXd error;     ///< bound on the error of each entry of S; infinite if no bound can be given
  Eigen::MatrixXd response;  ///< relaxed u for a unit of each boundary unknown
  double imbalance = 0.0;    ///< largest residual force |A^T k (A u + B e)| over all unknowns and columns
  double load = 0.0;         ///< largest residual force at u = 0, |A^T k B e|, over all unknowns and columns
  int steps = 0;             ///< largest number of refinement steps of a column
  bool converged = true;     ///< whether the error bound (or estimate) reached the tolerance in every column
};

/// Computes the static condensation of a system of springs. Residuals are summed spring by spring in extended
/// precision, so that the rounding of an assembled stiffness matrix K or of its factor does not affect the result; it
/// only slows the refinement.
///
/// The error bound has two parts. The first is r^T K^-1 r for the residual force r, which is twice the energy that
/// could still be released; it is bounded by r^T M^-1 r over `smallest_ratio` (or by |r|^2 |K^-1|). The second is the
/// rounding of the entries of A and B, which are assumed correct to a few units in the last place. It changes the
/// energy by the derivative with respect to these entries at fixed u, and by the square of the change of each spring's
/// elongation; no condition number enters.
[[nodiscard]] Condensation condense(const SpringSystem& springs, const ApproximateInverse& inverse,
                                    const CondensationOptions& options);

}  // namespace floc
