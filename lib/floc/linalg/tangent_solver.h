#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <optional>

namespace floc {

/// Method by which the linear systems of Newton's iterations are solved.
enum class TangentMethod {
  lu,        ///< a factor of each matrix (UMFPACK)
  cholesky,  ///< BiCGSTAB with the Cholesky factor of the symmetric part, kept from one matrix to the next
  diagonal,  ///< BiCGSTAB with the diagonal: no factor at all
};

/// Layout of the unknowns of a tangent: those of the grains, the same number for each, then those of the
/// boundary.
struct TangentLayout {
  int unknowns_a_grain = 1;
  int n_boundary = 0;
};

/// Method expected to be the fastest, and its predicted cost.
struct TangentPlan {
  TangentMethod method = TangentMethod::lu;
  double seconds = 0.0;    ///< predicted time of one core for the few matrices of one Newton solution
  bool lu_at_need = true;  ///< whether an LU factor is affordable where the iteration does not converge
};

/// Chooses the method from the symbolic analysis of the pattern; nothing of the size of a factor is allocated.
/// @param tangent  matrix of which only the pattern, which is symmetric, is read
TangentPlan plan_tangent(const Eigen::SparseMatrix<double>& tangent, const TangentLayout& layout);

/// Solver for the matrices of successive Newton iterations, all of one pattern and, apart from the boundary's
/// unknowns, close to symmetric and positive. Where many contacts slide they no longer are, and an LU factor is
/// used instead.
class TangentSolver {
 public:
  TangentSolver(const TangentPlan& plan, const TangentLayout& layout);
  ~TangentSolver();

  /// Sets the matrix of the next solve(), column-major.
  /// @return false when it is singular to working precision or not finite
  [[nodiscard]] bool set_matrix(const Eigen::SparseMatrix<double>& tangent);

  /// Solves matrix * x = b, to rounding with an LU factor, else to 1e-8 of b; no value where neither succeeds.
  [[nodiscard]] std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b);

 private:
  class Krylov;
  struct Methods;
  std::unique_ptr<Methods> methods_;
};

}  // namespace floc
