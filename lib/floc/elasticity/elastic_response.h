#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "floc/linalg/symmetric_factor.h"
#include "floc/network/free_motions.h"
#include "floc/network/stiffness_matrix.h"

namespace floc {

/// Method that solves for the motion of the grains under a strain.
enum class ResponseSolver {
  factor,         ///< Cholesky factor of the stiffness matrix K in double precision; gives error bounds
  single_factor,  ///< factor in single precision, refined in double: half the memory; gives error estimates
};

struct ResponseOptions {
  ResponseSolver solver = ResponseSolver::factor;
  StrainSet strains = StrainSet::diagonal;
  bool prestress = false;  ///< adds the geometric terms of the normal forces, see StiffnessOptions
  Ordering ordering = Ordering::automatic;
  /// Relative tolerance on the diagonal entries of `relaxed`: refinement continues until their error bounds are below
  /// it or until rounding stops the progress. With the default value, one refinement step usually suffices.
  double tolerance = 1e-11;
  /// Largest absolute eigenvalue of the stiffness matrix K that counts as a mechanism, in units of the largest contact
  /// stiffness (with rotations multiplied by the grain's size). It is used where K may be indefinite; otherwise the
  /// rank of the square root of K decides. Rounding of K moves an eigenvalue by some 1e-15. Near-mechanisms of real
  /// packings, which carry 3 % of B, have been seen down to 6e-13; they must stay above this bound.
  double mechanism_bound = 1e-13;
  /// Largest size of a factor in double precision (bytes). A factor whose predicted size is larger is not computed.
  double largest_factor = std::numeric_limits<double>::infinity();
};

/// Linear response of a network to strains of its cell, with no contact sliding.
struct ElasticResponse {
  /// Volume times stress per unit strain, with the grains relaxed (rows and columns in the order of StrainSet): the
  /// Schur complement of the grains in the stiffness matrix K. Symmetric. Without prestress, dividing it by the volume
  /// gives the moduli.
  Eigen::MatrixXd relaxed;
  /// Bound on the error of each entry of `relaxed`. It contains the remaining imbalance of the forces and the rounding
  /// of the contacts' geometry (branches are assumed correct to a few units in the last place). Infinite if no bound
  /// can be given.
  Eigen::MatrixXd error;
  /// Fluctuation of the grains (motion relative to the affine motion) per unit strain: one row per unknown of K, one
  /// column per strain. Zero for unknowns that no contact determines.
  Eigen::MatrixXd fluctuation;
  /// Common displacement of the two walls of an axis per unit strain, at which both walls bear the same force; one row
  /// per axis. Empty without walls.
  Eigen::MatrixXd wall_shift;
  FreeMotions free;
  int n_free_shifts = 0;  ///< number of motions of pairs of walls, with the grains, that no stiffness resists
  int n_negative =
      0;  ///< number of negative eigenvalues of grains and wall shifts, unstable dead ends included
  /// number of negative eigenvalues of the wall shifts alone, after the grains have relaxed
  int n_negative_shifts = 0;
  int n_mechanisms = 0;    ///< number of zero eigenvalues of K in addition to the motions in `free`
  double residual = 0.0;   ///< relative backward error of the solution: imbalance over the size of the terms
  double condition = 1.0;  ///< estimated condition number of K; infinite if there are mechanisms
  bool resolved = true;    ///< false if no digit is correct, even with the square root of K
  /// False if the solver counts neither negative eigenvalues nor mechanisms; `error` is then an estimate.
  bool counted = true;
  int steps = 0;  ///< number of refinement steps
  /// Reason why there is no response, as a sentence; empty if there is a response.
  std::string failure;
  /// Predicted size of the factor (bytes) if the failure is that the factor would be too large; otherwise 0.
  double factor_bytes = 0.0;
};

/// Solves for the response of a network to strains of its cell. A singular or indefinite stiffness matrix K is a
/// result, not an error: without prestress and without attractions across gaps, a mechanism of the grains cannot couple
/// to strain, so that `relaxed` is still exact.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options);

/// Solves for the response with a given factor, whose symbolic part is reused from one network to the next as long as
/// the contacts are the same. The factor's own ordering is used; `options.ordering` is ignored.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options, SymmetricFactor& factor);

/// Solution and factor that are kept from one state to the next. The solution is the start of the next iteration; the
/// factor is its preconditioner as long as few contacts have changed.
struct ResponseMemory {
  std::unique_ptr<SymmetricFactor> factor;
  std::vector<int> unknown;     ///< unknown of the stiffness matrix K to which each row of the factor belongs
  Eigen::VectorXd length;       ///< scale of each row of the factor: unknown of K = length * value in the row
  Eigen::MatrixXd fluctuation;  ///< fluctuation of the grains of the last network, see ElasticResponse
};

/// Solves for the response by conjugate gradients. The iteration starts from the solution kept in `memory`, is
/// preconditioned by the factor kept there, and ends when the estimated error is within the tolerance of the options. A
/// new factor is computed and kept if `memory` is empty, if the number of grains has changed, or if the iteration takes
/// many steps.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options, ResponseMemory& memory);

}  // namespace floc
