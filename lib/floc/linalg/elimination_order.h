#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace floc {

/// Method by which an order of elimination is found.
enum class Ordering {
  automatic,  ///< amd; where its factor would take long, the better of amd and metis
  amd,        ///< approximate minimum degree: fast to find
  metis,      ///< nested dissection: less fill in large matrices, slower to find
};

/// Returns the place of each unknown of a symmetric matrix (lower triangle, column-major) in an order of
/// elimination that keeps its Cholesky factor sparse. It is a postorder of the elimination tree, so that
/// columns of the same pattern are neighbours.
/// @param group  of each unknown, ascending from 0: unknowns of one group (a grain) are ordered together, which
///               is faster by the square of its size and just as good.
/// @throws std::runtime_error when memory runs out.
Eigen::VectorXi elimination_places(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group,
                                   Ordering ordering);

}  // namespace floc
