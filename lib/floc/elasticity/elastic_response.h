#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "floc/linalg/symmetric_factor.h"
#include "floc/network/free_motions.h"
#include "floc/network/stiffness_matrix.h"

namespace floc {

/// Method by which the grains are relaxed.
enum class ResponseSolver {
  factor,         ///< by a Cholesky factor of K in double precision, with error bounds
  single_factor,  ///< by a factor in single precision, refined in double: half the memory, error estimates
};

struct ResponseOptions {
  ResponseSolver solver = ResponseSolver::factor;
  StrainSet strains = StrainSet::diagonal;
  bool prestress = false;  ///< geometric terms, see StiffnessOptions
  Ordering ordering = Ordering::automatic;
  /// Relative tolerance on the diagonal of `relaxed`: refinement goes on until the error bound is below this,
  /// or rounding is reached. The default seldom costs more than one step.
  double tolerance = 1e-11;
  /// Eigenvalues of K within this of zero, in units of the largest contact stiffness (rotations times the
  /// grain's size), are mechanisms where K may be indefinite; otherwise the rank of its square root decides.
  /// Rounding of K moves an eigenvalue by some 1e-15; near-mechanisms of real packings have been seen down to
  /// 6e-13 and carry 3 % of B, so they must stay above.
  double mechanism_bound = 1e-13;
  /// Bytes that a factor in double precision may take; one that is predicted to be larger is not made.
  double largest_factor = std::numeric_limits<double>::infinity();
};

/// Linear response of a network to strains of its cell, with no contact sliding.
struct ElasticResponse {
  /// Volume times stress per unit strain (rows and columns in the order of StrainSet), with the grains relaxed:
  /// the Schur complement of the grains in K. Symmetric; without prestress, the moduli are this over the
  /// volume.
  Eigen::MatrixXd relaxed;
  /// Bound on the error of each entry of `relaxed`, from the imbalance that is left and the rounding of the
  /// contacts' geometry (branches are taken as right to a few units in the last place); infinite where none can
  /// be given.
  Eigen::MatrixXd error;
  /// Fluctuation of the grains per unit strain: rows are the unknowns of K, one column per strain. Zero for
  /// unknowns that no contact determines.
  Eigen::MatrixXd fluctuation;
  /// Between walls: displacement per unit strain that the two walls of an axis share, one row per axis, such
  /// that both bear the same. Empty without walls.
  Eigen::MatrixXd wall_shift;
  FreeMotions free;
  int n_free_shifts = 0;  ///< ways in which walls move together at no cost, and the grains with them
  int n_negative = 0;     ///< negative eigenvalues of grains and shifts of walls, unstable dead ends included
  int n_negative_shifts = 0;  ///< negative eigenvalues of the shifts alone, once the grains have relaxed
  int n_mechanisms = 0;       ///< vanishing eigenvalues of K beyond those of `free`
  double residual = 0.0;      ///< backward error of the solution
  double condition = 1.0;     ///< estimated condition number of K; infinite with mechanisms
  bool resolved = true;       ///< false where even the square root of K leaves no correct digit
  /// False where the solver counts neither negative eigenvalues nor mechanisms, and `error` is an estimate.
  bool counted = true;
  int steps = 0;  ///< number of refinement steps
  /// Reason why there is no response, in words; empty where there is one.
  std::string failure;
  /// Predicted size of the factor (bytes), where that is the reason of the failure; else 0.
  double factor_bytes = 0.0;
};

/// Solves for the response. A singular or indefinite K is a result, not an error: without prestress and distant
/// bonds a mechanism of the grains cannot couple to strain, so `relaxed` is still exact.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options);

/// Solves for the response with a given factor, which keeps its symbolic part from one network to the next as
/// long as the contacts stay the same. The ordering is that of the factor; `options.ordering` is ignored.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options, SymmetricFactor& factor);

/// Solution and factor kept from one state to the next. The solution is the start of the next iteration; the
/// factor serves as its preconditioner as long as few contacts have changed.
struct ResponseMemory {
  std::unique_ptr<SymmetricFactor> factor;
  std::vector<int> unknown;     ///< unknown of K that each row of the factor stands for
  Eigen::VectorXd length;       ///< scale of each row: unknown of K = length * value in the row
  Eigen::MatrixXd fluctuation;  ///< fluctuation of the last network, see ElasticResponse
};

/// Solves for the response by conjugate gradients. The iteration starts from the solution that `memory` holds,
/// with its factor as preconditioner, and ends when the estimated error is within the tolerance of the options.
/// The network is factorized, and the factor kept, if it is the first one, if its number of grains has changed,
/// or if the iteration takes long.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options, ResponseMemory& memory);

}  // namespace floc
