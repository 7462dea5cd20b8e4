#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace floc {

/// Method that finds the order in which the unknowns of a matrix are eliminated.
enum class Ordering {
  automatic,  ///< amd; if its factorization would take long, the better of amd and metis
  amd,        ///< approximate minimum degree: fast to find
  metis,      ///< nested dissection: less fill in large matrices, slower to find
};

/// Returns the place of each unknown of a symmetric matrix (lower triangle, column-major) in an elimination order that
/// keeps its Cholesky factor sparse. The order is a postorder of the elimination tree, so that columns with the same
/// pattern are neighbours.
/// @param group  group (grain) of each unknown, ascending from 0; the unknowns of a group are ordered together, which
///               is faster by the square of the group's size and gives an equally sparse factor
/// @throws std::runtime_error if memory runs out
Eigen::VectorXi elimination_places(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group,
                                   Ordering ordering);

}  // namespace floc
