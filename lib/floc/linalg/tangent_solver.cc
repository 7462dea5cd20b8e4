#include "floc/linalg/tangent_solver.h"

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>

#include "floc/linalg/symmetric_factor.h"
#include "floc/linalg/unsymmetric_factor.h"

namespace floc {
namespace {

/// BiCGSTAB ends when the norm of the residual, divided by the norm of the right-hand side, is at most this value.
constexpr double kTolerance = 1e-8;
/// Shifts that are added to the diagonal of the symmetric part of the tangent matrix, one after another, until this
/// part is positive definite. The shifts are given as fractions of the largest entry of the matrix; each shift is
/// kTangentNextShift times the previous one. Without a shift, the symmetric part may be indefinite: the normal force of
/// a compressed contact causes a small negative stiffness along the tangents of the contact.
constexpr double kTangentFirstShift = 1e-9;
constexpr double kTangentLastShift = 1e-2;
constexpr double kTangentNextShift = 100.0;
/// If BiCGSTAB needs more than this number of steps with a Cholesky factor of an earlier matrix, the factor is replaced
/// by a new one.
constexpr int kStaleSteps = 30;
/// Largest numbers of BiCGSTAB steps: with a Cholesky factor as preconditioner, and with the diagonal as
/// preconditioner.
constexpr int kMostStepsWithFactor = 60;
constexpr int kMostStepsWithDiagonal = 4000;

/// Returns the diagonal of a matrix, with 1 in place of zero entries.
Eigen::VectorXd safe_diagonal(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::VectorXd d = matrix.diagonal();
  return (d.array().abs() > 0.0).select(d, 1.0);
}

/// Returns, for each of the first n unknowns, the index of the grain to which it belongs.
/// @pre none of these unknowns is an unknown of the boundary
std::vector<int> grain_of_unknowns(Eigen::Index n, const TangentLayout& layout) {
  std::vector<int> grain(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < grain.size(); ++k) grain[k] = static_cast<int>(k) / layout.unknowns_a_grain;
  return grain;
}

/// Cholesky factor of the symmetric part of the tangent matrix. The unknowns of the boundary are eliminated last; if
/// they were eliminated earlier, the factor would not be sparse.
class SymmetricPart {
 public:
  explicit SymmetricPart(const TangentLayout& layout) : layout_(layout) {}

  bool factorize(const Eigen::SparseMatrix<double>& tangent) {
    const Eigen::Index n = tangent.rows() - layout_.n_boundary, m = layout_.n_boundary;
    const Eigen::SparseMatrix<double> transposed = tangent.transpose();
    const Eigen::SparseMatrix<double> part = 0.5 * (tangent + transposed);
    factor_.set_matrix(part.topLeftCorner(n, n).triangularView<Eigen::Lower>(), grain_of_unknowns(n, layout_));
    bool positive = false;
    for (double shift = kTangentFirstShift; !positive && shift < kTangentLastShift; shift *= kTangentNextShift)
      positive = factor_.factorize_positive(shift);
    if (!positive) return false;
    border_ = Eigen::MatrixXd(part.topRightCorner(n, m));
    response_ = factor_.solve(border_, 0);
    boundary_.compute(Eigen::MatrixXd(part.bottomRightCorner(m, m)) - border_.transpose() * response_);
    return true;
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    const Eigen::Index n = border_.rows(), m = border_.cols();
    Eigen::VectorXd x(b.size());
    x.head(n) = factor_.solve(b.head(n), 0);
    if (m > 0) {
      x.tail(m) = boundary_.solve(b.tail(m) - border_.transpose() * x.head(n));
      x.head(n) -= response_ * x.tail(m);
    }
    return x;
  }

 private:
  TangentLayout layout_;
  SymmetricFactor factor_;
  Eigen::MatrixXd border_, response_;
  Eigen::PartialPivLU<Eigen::MatrixXd> boundary_;
};

/// Preconditioner in the form that Eigen's iterative solvers expect.
class Preconditioner {
 public:
  template <class Matrix>
  Preconditioner& compute(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  Preconditioner& analyzePattern(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  Preconditioner& factorize(const Matrix&) {
    return *this;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    return part != nullptr ? part->solve(b) : Eigen::VectorXd(b.cwiseQuotient(*diagonal));
  }
  static Eigen::ComputationInfo info() { return Eigen::Success; }

  const SymmetricPart* part = nullptr;  // null: `diagonal` is used instead
  const Eigen::VectorXd* diagonal = nullptr;
};

}  // namespace

TangentPlan plan_tangent(const Eigen::SparseMatrix<double>& tangent, const TangentLayout& layout) {
  /// Constants for the prediction of times: the number of matrices in a Newton solution, the rates of one core
  /// (floating-point operations per second), and the numbers of BiCGSTAB steps. These constants were measured with 500
  /// and 4000 spheres at 10 kPa to 100 MPa (docs/numerics.md, "Linear systems in 3D").
  constexpr double kMatrices = 4.0;
  constexpr double kFactorRate = 15e9, kLuRate = 5e9, kSubstitutionRate = 3e9, kProductRate = 1.2e9;
  constexpr double kStepsWithFactor = 5.0, kStepsWithDiagonal = 300.0, kProductsPerStep = 2.0;
  // LU factors are chosen whenever their predicted time (seconds) is below this value, because LU factors are exact.
  constexpr double kNoMatter = 0.05;
  constexpr double kLargestFactor = 4e9;  // largest accepted size of a factor (bytes)
  // LU factors may replace BiCGSTAB, where it does not converge, if their predicted time (seconds) is below this value.
  constexpr double kAtNeed = 20.0;

  const Eigen::Index n = tangent.rows() - layout.n_boundary;
  SymmetricFactor factor;
  factor.set_matrix(tangent.topLeftCorner(n, n).triangularView<Eigen::Lower>(), grain_of_unknowns(n, layout));
  const FactorCost cost = factor.predicted_cost();
  const double product = 2.0 * static_cast<double>(tangent.nonZeros()) / kProductRate;
  const double substitution = 4.0 * (cost.bytes / sizeof(double)) / kSubstitutionRate;
  const double lu = kMatrices * 2.0 * cost.operations / kLuRate;
  const double cholesky = cost.operations / kFactorRate +
                          kMatrices * kStepsWithFactor * kProductsPerStep * (substitution + product);
  const double diagonal = kMatrices * kStepsWithDiagonal * kProductsPerStep * product;
  const bool fits = cost.bytes < kLargestFactor;
  if (fits && lu <= std::max(kNoMatter, std::min(cholesky, diagonal))) return {TangentMethod::lu, lu, true};
  const bool at_need = fits && lu < kAtNeed;
  if (fits && cholesky <= diagonal) return {TangentMethod::cholesky, cholesky, at_need};
  return {TangentMethod::diagonal, diagonal, at_need};
}

/// Solver by BiCGSTAB for a sequence of matrices, with a Cholesky factor or the diagonal as preconditioner.
class TangentSolver::Krylov {
 public:
  Krylov(const TangentLayout& layout, bool with_factor) : with_factor_(with_factor), part_(layout) {}

  bool set_matrix(const Eigen::SparseMatrix<double>& tangent) {
    const double largest = tangent.nonZeros() == 0 ? 0.0 : tangent.coeffs().cwiseAbs().maxCoeff();
    if (!std::isfinite(tangent.coeffs().sum())) return false;
    unit_ = largest > 0.0 ? std::exp2(-std::ilogb(largest)) : 1.0;
    matrix_ = unit_ * tangent;
    diagonal_ = safe_diagonal(matrix_);
    fresh_ = false;
    if (with_factor_ && (!has_factor_ || steps_ > kStaleSteps)) renew();
    return true;
  }

  std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b) {
    std::optional<Eigen::VectorXd> x = iterate(b);
    if (x || !with_factor_ || fresh_) return x;
    renew();
    return iterate(b);
  }

  /// Solves matrix * x = b by an LU factor of the current matrix.
  /// @return no value if the matrix is singular or not finite
  std::optional<Eigen::VectorXd> solve_by(UnsymmetricFactor& lu, const Eigen::VectorXd& b) const {
    if (!lu.factorize(matrix_)) return std::nullopt;
    return lu.solve(unit_ * b);
  }

 private:
  void renew() {
    has_factor_ = fresh_ = part_.factorize(matrix_);
    steps_ = 0;
  }

  std::optional<Eigen::VectorXd> iterate(const Eigen::VectorXd& b) {
    Eigen::BiCGSTAB<Eigen::SparseMatrix<double>, Preconditioner> solver;
    solver.preconditioner().part = has_factor_ ? &part_ : nullptr;
    solver.preconditioner().diagonal = &diagonal_;
    solver.setTolerance(kTolerance);
    solver.setMaxIterations(has_factor_ ? kMostStepsWithFactor : kMostStepsWithDiagonal);
    solver.compute(matrix_);
    Eigen::VectorXd x = solver.solve(unit_ * b);
    steps_ = static_cast<int>(solver.iterations());
    if (solver.info() != Eigen::Success || !x.allFinite()) return std::nullopt;
    return x;
  }

  bool with_factor_;
  SymmetricPart part_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::VectorXd diagonal_;
  double unit_ = 1.0;
  bool has_factor_ = false;
  bool fresh_ = false;  // whether the Cholesky factor was made for the current matrix
  int steps_ = 0;       // number of BiCGSTAB steps of the last solution
};

struct TangentSolver::Methods {
  TangentMethod method;
  bool lu_at_need;
  UnsymmetricFactor lu;
  Krylov krylov;
};

TangentSolver::TangentSolver(const TangentPlan& plan, const TangentLayout& layout)
    : methods_(
          new Methods{plan.method, plan.lu_at_need, {}, {layout, plan.method == TangentMethod::cholesky}}) {}
TangentSolver::~TangentSolver() = default;

bool TangentSolver::set_matrix(const Eigen::SparseMatrix<double>& tangent) {
  return methods_->method == TangentMethod::lu ? methods_->lu.factorize(tangent)
                                               : methods_->krylov.set_matrix(tangent);
}

std::optional<Eigen::VectorXd> TangentSolver::solve(const Eigen::VectorXd& b) {
  Methods& m = *methods_;
  if (m.method == TangentMethod::lu) return m.lu.solve(b);
  std::optional<Eigen::VectorXd> x = m.krylov.solve(b);
  if (x || !m.lu_at_need) return x;
  m.method = TangentMethod::lu;  // BiCGSTAB would not converge for later matrices
  return m.krylov.solve_by(m.lu, b);
}

}  // namespace floc
