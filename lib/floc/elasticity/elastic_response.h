#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "floc/linalg/symmetric_factor.h"
#include "floc/network/free_motions.h"
#include "floc/network/stiffness_matrix.h"

namespace floc {

/// Method that solves for the motion of the grains under a strain of the cell.
enum class ResponseSolver {
  factor,  ///< Cholesky factor of the stiffness matrix K in double precision; gives error bounds
  /// Cholesky factor of K in single precision, with refinement in double precision; needs half the memory and gives
  /// error estimates
  single_factor,
};

struct ResponseOptions {
  ResponseSolver solver = ResponseSolver::factor;
  StrainSet strains = StrainSet::diagonal;
  /// whether the stiffness matrix K contains the geometric terms of the normal forces, see StiffnessOptions
  bool prestress = false;
  Ordering ordering = Ordering::automatic;
  /// Tolerance on the relative error of each diagonal entry of ElasticResponse::relaxed. The solution is refined until
  /// the error bounds are below this tolerance or until rounding prevents further progress. With the default value, one
  /// refinement step usually suffices.
  double tolerance = 1e-11;
  /// Largest absolute eigenvalue of the stiffness matrix K that counts as a mechanism, divided by the largest contact
  /// stiffness. In K, rotations are multiplied by the grain's size. Rounding of K changes an eigenvalue by some 1e-15.
  /// The bound must be below the eigenvalues of near-mechanisms: in real packings, near-mechanisms with eigenvalues
  /// down to 6e-13 have contributed 3 % of the bulk modulus. The bound is used only if K may be indefinite. Otherwise
  /// mechanisms are found from the rank of the square root of K.
  double mechanism_bound = 1e-13;
  /// A motion also counts as a mechanism if it stretches the springs of the network (in units of sqrt(K_N)) by at most
  /// this share of the size of the motion. Used only if K has no reliable Cholesky factor and no contact has a negative
  /// stiffness. With 0, a motion counts only if double precision cannot resolve its stiffness.
  double mechanism_length = 0.0;
  /// Largest size of a factor of K in double precision (bytes). A factor whose predicted size is larger is not
  /// computed.
  double largest_factor = std::numeric_limits<double>::infinity();
};

/// Linear response of a contact network to strains of its cell, if no contact slides.
struct ElasticResponse {
  /// Volume times stress per unit strain of the cell after relaxation of the grains: the Schur complement of the
  /// strains in the stiffness matrix K of grains and strains. The matrix is symmetric, with rows and columns in the
  /// order of StrainSet. Without prestress, `relaxed` divided by the volume is the matrix of moduli.
  Eigen::MatrixXd relaxed;
  /// Bound on the error of each entry of `relaxed`, due to the net forces that remain on grains and to rounding in the
  /// geometry of the contacts. The vectors between centres are assumed correct to a few units in the last place.
  /// Infinite if no bound can be given.
  Eigen::MatrixXd error;
  /// Fluctuation of the grains (their motion relative to the affine motion) per unit strain: one row per unknown of the
  /// stiffness matrix K, one column per strain of the cell. Rows of unknowns whose motion no contact resists are zero.
  Eigen::MatrixXd fluctuation;
  /// For each axis with walls, the wall shift per unit strain: the common displacement of the two walls at which the
  /// forces on both walls are equal. One row per axis, one column per strain. Zero for the other axes.
  Eigen::MatrixXd wall_shift;
  FreeMotions free;
  /// number of independent wall shifts (common displacements of the two walls of an axis) that no stiffness resists
  /// after relaxation of the grains
  int n_free_shifts = 0;
  /// number of negative eigenvalues of the stiffness matrix of grains, wall shifts and dead ends
  int n_negative = 0;
  /// number of negative eigenvalues of the stiffness against wall shifts (`wall_shift`) after relaxation of the grains
  int n_negative_shifts = 0;
  /// number of zero eigenvalues of the stiffness matrix K, except the free motions in `free`
  int n_mechanisms = 0;
  /// relative backward error of the solution: largest net force on a grain, divided by the size of the forces whose sum
  /// is this net force
  double residual = 0.0;
  /// estimated condition number of the stiffness matrix K; infinite if there are mechanisms
  double condition = 1.0;
  /// false if rounding leaves no digit of `relaxed` correct, even if the square root of the stiffness matrix is
  /// factorized
  bool resolved = true;
  /// Whether the solver counts negative eigenvalues and mechanisms. If it does not, `error` is an estimate instead of a
  /// bound.
  bool counted = true;
  int steps = 0;  ///< number of refinement steps of the solution
  /// Reason why there is no response, as a sentence; empty if there is a response.
  std::string failure;
  /// Predicted size (bytes) of the factor of the stiffness matrix if there is no response because the factor is too
  /// large; otherwise 0.
  double factor_bytes = 0.0;
};

/// Solves for the response of a network to strains of its cell. A singular or indefinite stiffness matrix K is a
/// result, not an error. Without prestress and without attractions across gaps, a mechanism of the grains cannot couple
/// to strain. Therefore ElasticResponse::relaxed is then exact even if K is singular.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options);

/// Solves for the response of a network. The factor of the stiffness matrix is returned in `factor`. If `factor`
/// already contains the factor of an earlier network with the same contacts, its symbolic part is used again. The
/// ordering of `factor` replaces `options.ordering`.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options, SymmetricFactor& factor);

/// Solution and factor of the elastic response of one state, kept for the next state. Conjugate gradients start from
/// the solution. The factor is their preconditioner as long as few contacts have changed.
struct ResponseMemory {
  std::unique_ptr<SymmetricFactor> factor;
  std::vector<int> unknown;  ///< for each row of the factor, the number of its unknown in the stiffness matrix
  /// for each row of the factor, the ratio of the unknown to the value solved for: 1/(size of the grain) for rotations,
  /// otherwise 1
  Eigen::VectorXd length;
  Eigen::MatrixXd fluctuation;  ///< fluctuation of the grains of the last network, see ElasticResponse
};

/// Solves for the elastic response of a network by conjugate gradients. The iteration starts from the solution in
/// `memory` and uses the factor in `memory` as preconditioner. It ends when the estimated error is within
/// `options.tolerance`. A new factor is computed and kept if `memory` is empty, if the number of grains has changed, or
/// if the iteration takes many steps.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options, ResponseMemory& memory);

}  // namespace floc
