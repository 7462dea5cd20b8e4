#pragma once

#include <memory>
#include <vector>

#include "floc/lattice/spring_rows.h"

namespace floc {

/// Approximate inverse of the stiffness matrix of springs, whose unknowns are the motions of nodes and the strains that
/// are not imposed.
template <int Dim, int Size>
class SpringPreconditioner {
 public:
  using Strains = Eigen::Matrix<double, kSymmetric<Dim>, 1>;

  virtual ~SpringPreconditioner() = default;
  /// Prepares the inverse for the springs that are closed. @param active  one entry per row: whether its spring is
  /// closed
  virtual void prepare(const std::vector<char>& active) = 0;
  /// Sets which strains are free, that is, not imposed.
  virtual void set_free(const Eigen::Matrix<bool, kSymmetric<Dim>, 1>& free) = 0;
  /// Returns the inverse times a residual, whose entries are those of nodes, then of strains; the result is zero for
  /// strains that are not free.
  virtual Eigen::VectorXd apply(const Eigen::VectorXd& residual) const = 0;
  /// Returns whether the inverse is nearly exact for the prepared springs, so that it remains useful if a few springs
  /// open or close.
  virtual bool is_exact() const = 0;
};

/// Returns a preconditioner by a Cholesky factor. The diagonal is shifted by 1e-9 of the largest stiffness, because
/// some motions may have no stiffness.
template <int Dim, int Size>
std::unique_ptr<SpringPreconditioner<Dim, Size>> factor_preconditioner(const SpringRows<Dim, Size>& springs);

/// Returns a preconditioner by the diagonal blocks of the nodes and the affine stiffness of the strains.
template <int Dim, int Size>
std::unique_ptr<SpringPreconditioner<Dim, Size>> block_preconditioner(const SpringRows<Dim, Size>& springs);

}  // namespace floc
