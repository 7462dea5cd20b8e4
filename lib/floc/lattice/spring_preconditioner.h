#pragma once

#include <memory>
#include <vector>

#include "floc/lattice/spring_rows.h"

namespace floc {

/// Approximate inverse of the stiffness matrix of springs. The unknowns of the matrix are first the motions of the
/// nodes, then the strains of the cell.
template <int Dim, int Size>
class SpringPreconditioner {
 public:
  using Strains = Eigen::Matrix<double, kSymmetric<Dim>, 1>;

  virtual ~SpringPreconditioner() = default;
  /// Computes the approximate inverse for a given set of closed springs; must be called before apply().
  /// @param active  for each spring, whether it is closed
  virtual void prepare(const std::vector<char>& active) = 0;
  /// For each strain, sets whether it is free. Free strains are unknowns; all other strains have imposed values.
  virtual void set_free(const Eigen::Matrix<bool, kSymmetric<Dim>, 1>& free) = 0;
  /// Returns the product of the approximate inverse with a residual; zero for strains that are not free.
  /// @param residual  entries for the motions of the nodes, then for the strains
  virtual Eigen::VectorXd apply(const Eigen::VectorXd& residual) const = 0;
  /// Returns whether the inverse is nearly exact for the closed springs given to prepare(). A nearly exact inverse
  /// remains useful if a few springs open or close.
  virtual bool is_exact() const = 0;
};

/// Returns a preconditioner that uses a Cholesky factor. Before the factorization, a small shift (1e-9 of the largest
/// stiffness) is added to the diagonal of the matrix, because some motions may have no stiffness.
template <int Dim, int Size>
std::unique_ptr<SpringPreconditioner<Dim, Size>> factor_preconditioner(const SpringRows<Dim, Size>& springs);

/// Returns a preconditioner that consists of the diagonal blocks of the nodes, and of the stiffness against strain
/// without relaxation of the nodes.
template <int Dim, int Size>
std::unique_ptr<SpringPreconditioner<Dim, Size>> block_preconditioner(const SpringRows<Dim, Size>& springs);

}  // namespace floc
