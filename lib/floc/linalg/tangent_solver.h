#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <optional>

namespace floc {

/// Method that solves the linear systems of Newton's iterations.
enum class TangentMethod {
  lu,        ///< LU factor of each matrix (UMFPACK)
  cholesky,  ///< BiCGSTAB with the Cholesky factor of the symmetric part as preconditioner, kept for several matrices
  diagonal,  ///< BiCGSTAB with the diagonal as preconditioner, without any factor
};

/// Layout of the unknowns of a tangent matrix: first the unknowns of the grains, the same number for each grain, then
/// the unknowns of the boundary.
struct TangentLayout {
  int unknowns_a_grain = 1;
  int n_boundary = 0;
};

/// Method for the linear systems of a Newton solution that is predicted to be the fastest, and its predicted cost.
struct TangentPlan {
  TangentMethod method = TangentMethod::lu;
  double seconds = 0.0;  ///< predicted time of the matrices of one Newton solution on one core (seconds)
  /// whether to use an LU factor if the iteration does not converge, because its cost is acceptable
  bool lu_at_need = true;
};

/// Chooses the method from the symbolic analysis of the pattern of the tangent matrix, without allocating a factor.
/// @param tangent  matrix whose pattern is read, which has to be symmetric; its values are not read
TangentPlan plan_tangent(const Eigen::SparseMatrix<double>& tangent, const TangentLayout& layout);

/// Solver for the linear systems of successive Newton iterations. All matrices have the same pattern and are, except
/// for the unknowns of the boundary, close to symmetric and positive. If many contacts slide, they are not, and an LU
/// factor is used instead.
class TangentSolver {
 public:
  TangentSolver(const TangentPlan& plan, const TangentLayout& layout);
  ~TangentSolver();

  /// Sets the matrix of the following calls of solve(), column-major.
  /// @return false if the matrix is singular to working precision or not finite
  [[nodiscard]] bool set_matrix(const Eigen::SparseMatrix<double>& tangent);

  /// Solves matrix * x = b: to rounding with an LU factor, otherwise to a residual of 1e-8 times b. @return no value if
  /// no method succeeds
  [[nodiscard]] std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b);

 private:
  class Krylov;
  struct Methods;
  std::unique_ptr<Methods> methods_;
};

}  // namespace floc
