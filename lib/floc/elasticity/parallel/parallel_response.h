#pragma once

#include <vector>

#include "floc/elasticity/elastic_response.h"
#include "floc/petsc/parallel_solver.h"

namespace floc {

/// Solves for the elastic response by conjugate gradients, without a factor. The grains are distributed over the
/// processes of the solver by position, and each process assembles the rows of its grains in the stiffness matrix. All
/// processes have to call this function with the same arguments, and all obtain the same response. In the response,
/// `error` is an estimate from the residual forces and the lowest Ritz value of the iteration. Mechanisms and negative
/// eigenvalues are not counted, and `fluctuation` is empty. If the iteration does not converge, for example because the
/// stiffness matrix is not positive definite, `failure` contains the reason.
/// @param centres  centres of all grains, inside or outside the cell (length)
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const std::vector<Vec<Dim>>& centres,
                                               const ResponseOptions& options, ParallelSolver& solver);

}  // namespace floc
