#pragma once

#include <memory>
#include <vector>

#include "floc/lattice/spring_rows.h"

namespace floc {

/// An approximate inverse of the stiffness of springs, over their nodes and the strains that are free.
template <int Dim, int Size>
class SpringPreconditioner {
 public:
  using Strains = Eigen::Matrix<double, kSymmetric<Dim>, 1>;

  virtual ~SpringPreconditioner() = default;
  /// Prepares the inverse for the rows that are closed. @param active  one entry per row: whether it is closed
  virtual void prepare(const std::vector<char>& active) = 0;
  /// Sets which strains are free from now on.
  virtual void set_free(const Eigen::Matrix<bool, kSymmetric<Dim>, 1>& free) = 0;
  /// Returns the inverse times a residual of nodes, then strains; strains that are not free stay zero.
  virtual Eigen::VectorXd apply(const Eigen::VectorXd& residual) const = 0;
  /// Whether the inverse is nearly exact for the prepared rows, so that it need not be prepared anew when few
  /// rows change.
  virtual bool is_exact() const = 0;
};

/// Makes a preconditioner by a Cholesky factor, with a shift of 1e-9 of the stiffness for motions that nothing
/// resists.
template <int Dim, int Size>
std::unique_ptr<SpringPreconditioner<Dim, Size>> factor_preconditioner(const SpringRows<Dim, Size>& springs);

/// Makes a preconditioner by the diagonal blocks of the nodes, and the stiffness of the strains under affine
/// motion.
template <int Dim, int Size>
std::unique_ptr<SpringPreconditioner<Dim, Size>> block_preconditioner(const SpringRows<Dim, Size>& springs);

}  // namespace floc
