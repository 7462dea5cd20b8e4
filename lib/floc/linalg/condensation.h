#pragma once

#include <Eigen/SparseCore>
#include <functional>

namespace floc {

/// System of springs that connect free unknowns u and boundary unknowns e. The elongations of the springs are
/// A u + B e. The energy of a spring is half its stiffness times the square of its elongation.
struct SpringSystem {
  /// matrix A: one row per spring, one column per free unknown
  Eigen::SparseMatrix<double, Eigen::RowMajor> on_free;
  /// B: one row per spring, one column per boundary unknown
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> on_boundary;
  Eigen::VectorXd stiffness;  ///< k: stiffness of each spring; may be negative
};

/// Approximation M^-1 of the inverse of the stiffness matrix K = A^T k A of a SpringSystem, with bounds on its quality.
struct ApproximateInverse {
  /// function that returns M^-1 b for a vector b
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> apply;
  /// Whether two matrices are positive semidefinite: the stiffness matrix K, and the matrix M whose inverse is the
  /// approximation. If true, condense() minimises the energy by conjugate gradients.
  bool definite = true;
  /// If `definite`: lower bound on the nonzero eigenvalues of M^-1 K; 0 if no bound is known, which makes the error
  /// bound of condense() infinite.
  double smallest_ratio = 0.0;
  /// If `definite`, and `smallest_ratio` is not known: whether condense() estimates it from the Ritz values of its
  /// conjugate gradients. The error that condense() returns is then only an estimate, because the Ritz values may miss
  /// a soft motion that the loads excite weakly.
  bool estimated_ratio = false;
  /// If not `definite`: upper bound on the 2-norm of K^-1; infinite if no bound is known.
  double inverse_norm = 0.0;
};

struct CondensationOptions {
  /// largest accepted error of a diagonal entry of the condensed stiffness, divided by this entry
  double tolerance = 1e-10;
  /// Largest number of refinement steps per boundary unknown. With a good approximate inverse, one step is enough, plus
  /// one step for each motion of almost zero stiffness that the approximate inverse does not resolve.
  int max_steps = 100;
  /// whether residual forces are computed in extended precision (long double); if false, in double precision, which is
  /// several times faster
  bool extended = true;
  /// the refinement stops after this number of consecutive steps without progress, because only rounding errors remain
  int patience = 5;
  /// Start values of the free unknowns u, one column per boundary unknown, such as `Condensation::response` of a
  /// similar system. If empty, the refinement starts from u = 0.
  Eigen::MatrixXd start = {};
};

/// Result of static condensation: the stiffness that the boundary unknowns e of a SpringSystem have when the free
/// unknowns u relax (a Schur complement).
struct Condensation {
  /// condensed stiffness S: 1/2 e^T S e is the minimum of the energy over u or, if A^T k A is indefinite, the
  /// stationary value of the energy
  Eigen::MatrixXd stiffness;
  /// bound on the error of each entry of `stiffness`; infinite if no bound can be given
  Eigen::MatrixXd error;
  /// free unknowns u after relaxation; column j is for boundary unknown j displaced by 1
  Eigen::MatrixXd response;
  /// largest residual force |A^T k (A u + B e)| on a free unknown, in any column of `response`
  double imbalance = 0.0;
  /// largest force |A^T k B e| on a free unknown before relaxation (u = 0). The maximum is over all cases in which one
  /// boundary unknown is displaced by 1.
  double load = 0.0;
  int steps = 0;          ///< largest number of refinement steps that a column of `response` needed
  bool converged = true;  ///< whether the error of every diagonal entry of `stiffness` is within the tolerance
};

/// Computes the static condensation of a SpringSystem with the matrices A, B and k and the stiffness matrix K = A^T k
/// A. The method is refinement with an approximate inverse M^-1 of K. Residual forces are summed spring by spring in
/// extended precision. Therefore rounding errors of K, or of a factor of K, slow the refinement, but do not affect the
/// result.
///
/// The error bound is the sum of two terms:
/// 1. r^T K^-1 r for the residual force r. This is twice the energy that further relaxation would release. An upper
///    bound is r^T M^-1 r / `smallest_ratio`, or |r|^2 |K^-1| if K is indefinite.
/// 2. The effect of rounding errors of the entries of A and B, which are assumed correct to a few units in the last
///    place. The effect is the change of the energy at fixed u, including terms of second order. It does not depend on
///    a condition number.
[[nodiscard]] Condensation condense(const SpringSystem& springs, const ApproximateInverse& inverse,
                                    const CondensationOptions& options);

}  // namespace floc
