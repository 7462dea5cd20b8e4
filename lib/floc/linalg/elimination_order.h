#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace floc {

/// Method that finds the order in which the unknowns of a sparse matrix are eliminated.
enum class Ordering {
  /// order of amd or, if a factorization in this order would take long, the better of the orders of amd and metis
  automatic,
  amd,    ///< approximate minimum degree: fast to find
  metis,  ///< nested dissection: slower to find, but fewer nonzero entries in the factors of large matrices
};

/// Returns the place of each unknown of a symmetric matrix in an elimination order that keeps the Cholesky factor
/// sparse. The order is a postorder of the elimination tree, which places columns of the factor with the same pattern
/// next to each other.
/// @param lower  lower triangle of the matrix, column-major
/// @param group  number of the group (grain) to which each unknown belongs, ascending from 0. The unknowns of a group
///               are placed together. This makes the search for an order faster by the square of the group size, and no
///               sparsity of the factor is lost
/// @throws std::runtime_error if memory runs out
Eigen::VectorXi elimination_places(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group,
                                   Ordering ordering);

}  // namespace floc
