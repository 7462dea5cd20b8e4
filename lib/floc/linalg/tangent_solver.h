#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <optional>

namespace floc {

/// Method that solves the linear systems of a Newton iteration. The matrix of each system is a tangent matrix.
enum class TangentMethod {
  lu,  ///< LU factor of each tangent matrix (UMFPACK)
  /// BiCGSTAB, preconditioned by a Cholesky factor of the symmetric part of a matrix; one factor serves several
  /// matrices
  cholesky,
  diagonal,  ///< BiCGSTAB, preconditioned by the diagonal of the matrix; no factor
};

/// Layout of the unknowns of a tangent matrix: first the unknowns of the grains, the same number for each grain, then
/// the unknowns of the boundary.
struct TangentLayout {
  int unknowns_a_grain = 1;
  int n_boundary = 0;
};

/// The method that is predicted to be the fastest for the linear systems of a Newton solution, and its predicted cost.
struct TangentPlan {
  TangentMethod method = TangentMethod::lu;
  /// predicted time to solve all linear systems of one Newton solution on one core (seconds)
  double seconds = 0.0;
  /// whether an LU factor may replace BiCGSTAB if BiCGSTAB does not converge; false if the LU factor is predicted to be
  /// too large or too slow
  bool lu_at_need = true;
};

/// Chooses the method for the linear systems from a symbolic analysis of the pattern of the tangent matrix. No factor
/// is allocated.
/// @param tangent  matrix with a symmetric pattern; its values are not used
TangentPlan plan_tangent(const Eigen::SparseMatrix<double>& tangent, const TangentLayout& layout);

/// Solver for the linear systems of successive Newton steps. All matrices have the same pattern. The block of the
/// grains should be nearly symmetric and positive definite. This holds unless many contacts slide. If BiCGSTAB does not
/// converge and TangentPlan::lu_at_need is true, an LU factor replaces BiCGSTAB.
class TangentSolver {
 public:
  TangentSolver(const TangentPlan& plan, const TangentLayout& layout);
  ~TangentSolver();

  /// Sets the matrix (column-major) that later calls of solve() use.
  /// @return false if the matrix is singular to working precision or not finite
  [[nodiscard]] bool set_matrix(const Eigen::SparseMatrix<double>& tangent);

  /// Solves matrix * x = b. With an LU factor, the residual is a rounding error. With BiCGSTAB, the norm of the
  /// residual is at most 1e-8 times the norm of b.
  /// @return no value if no method succeeds
  [[nodiscard]] std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b);

 private:
  class Krylov;
  struct Methods;
  std::unique_ptr<Methods> methods_;
};

}  // namespace floc
