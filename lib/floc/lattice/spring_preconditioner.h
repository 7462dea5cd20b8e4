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
  /// Makes it for the rows that push or pull now, one entry per row.
  virtual void prepare(const std::vector<char>& active) = 0;
  /// Sets which strains are free from now on.
  virtual void set_free(const Eigen::Matrix<bool, kSymmetric<Dim>, 1>& free) = 0;
  /// Nodes, then strains; those that are not free stay zero.
  virtual Eigen::VectorXd apply(const Eigen::VectorXd& residual) const = 0;
  /// Whether it is so close to the inverse that remaking it is not worth more than some 30 applications.
  virtual bool is_exact() const = 0;
};

/// By a Cholesky factor, with a shift of 1e-9 of the stiffness for motions that nothing resists.
template <int Dim, int Size>
std::unique_ptr<SpringPreconditioner<Dim, Size>> factor_preconditioner(const SpringRows<Dim, Size>& springs);

/// By the diagonal blocks of the nodes, and the strains as if all nodes followed them.
template <int Dim, int Size>
std::unique_ptr<SpringPreconditioner<Dim, Size>> block_preconditioner(const SpringRows<Dim, Size>& springs);

}  // namespace floc
