#pragma once

#include <vector>

#include "floc/elasticity/elastic_response.h"
#include "floc/petsc/parallel_solver.h"

namespace floc {

/// Solves for the elastic response by conjugate gradients, without a factor. Grains are shared out in space
/// among the processes of the solver, each of which assembles the rows of its own grains. All processes have to
/// call it with the same arguments, and all get the same answer. `error` is an estimate from the residual
/// forces and the lowest Ritz value of the iteration; mechanisms and negative eigenvalues are not counted, and
/// `fluctuation` is empty. If the iteration does not converge, as for a stiffness that is not positive,
/// `failure` gives the reason.
/// @param centres  of all grains, in the cell or not (length): they divide the grains among the processes
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const std::vector<Vec<Dim>>& centres,
                                               const ResponseOptions& options, ParallelSolver& solver);

}  // namespace floc
