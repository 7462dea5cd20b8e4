#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "floc/linalg/symmetric_factor.h"
#include "floc/network/free_motions.h"
#include "floc/network/stiffness_matrix.h"

namespace floc {

/// How the grains are relaxed.
enum class ResponseSolver {
  factor,         ///< by a Cholesky factor of K in double precision, with error bounds
  single_factor,  ///< by one in single precision, refined in double: half the memory, error estimates
};

struct ResponseOptions {
  ResponseSolver solver = ResponseSolver::factor;
  StrainSet strains = StrainSet::diagonal;
  bool prestress = false;  ///< geometric terms, see StiffnessOptions
  Ordering ordering = Ordering::automatic;
  /// Relative error wanted in the diagonal of `relaxed`: refinement goes on until its bound is below this, or
  /// rounding is reached. The default is seldom more than one step away.
  double tolerance = 1e-11;
  /// Eigenvalues of K within this of zero, in units of the largest contact stiffness (rotations times the
  /// grain's size), are mechanisms where K may be indefinite; otherwise the rank of its square root decides.
  /// Rounding of K moves an eigenvalue by some 1e-15; near-mechanisms of real packings have been seen down to
  /// 6e-13 and carry 3 % of B, so they must stay above.
  double mechanism_bound = 1e-13;
  /// Bytes that a factor in double precision may take; one that is predicted to be larger is not made.
  double largest_factor = std::numeric_limits<double>::infinity();
};

/// Linear response of a network to strains of its cell, nothing sliding.
struct ElasticResponse {
  /// Volume times stress per unit strain (rows and columns in the order of StrainSet), with the grains relaxed:
  /// the Schur complement of the grains in K. Symmetric; without prestress, the moduli are this over the
  /// volume.
  Eigen::MatrixXd relaxed;
  /// Bound on the error of each entry of `relaxed`, from the imbalance that is left and the rounding of the
  /// contacts' geometry (branches are taken as right to a few units in the last place); infinite where none can
  /// be given.
  Eigen::MatrixXd error;
  /// Fluctuation of the grains per unit strain: rows are the unknowns of K, one column per strain. Zero where
  /// nothing fixes it.
  Eigen::MatrixXd fluctuation;
  /// Between walls: displacement per unit strain that the two walls of an axis share, one row per axis, such
  /// that both bear the same. Empty without walls.
  Eigen::MatrixXd wall_shift;
  FreeMotions free;
  int n_free_shifts = 0;  ///< ways in which walls move together at no cost, and the grains with them
  int n_negative = 0;     ///< negative eigenvalues of grains and shifts of walls, unstable dead ends included
  int n_negative_shifts = 0;  ///< those among them that are of the shifts, once the grains have relaxed
  int n_mechanisms = 0;       ///< its vanishing eigenvalues beyond those of `free`
  double residual = 0.0;      ///< backward error of the solution
  double condition = 1.0;     ///< estimate, of K; infinite with mechanisms
  bool resolved = true;       ///< false where even the square root of K leaves no digit
  /// False where the solver finds neither negative eigenvalues nor mechanisms, and `error` is an estimate.
  bool counted = true;
  int steps = 0;  ///< of refinement
  /// Why there is no response, in words; empty where there is one.
  std::string failure;
  /// Predicted size of the factor (bytes), where that is the reason; else 0.
  double factor_bytes = 0.0;
};

/// Solves for the response. A singular or indefinite K is a result, not an error; without prestress and distant
/// bonds a mechanism of the grains cannot couple to strain, so `relaxed` is right all the same.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options);

/// The same with a factor that keeps its symbolic part from one network to the next with the same contacts; its
/// ordering is the one it was made with.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options, SymmetricFactor& factor);

/// What the response of one state provides for that of the next: a solution to start from, and a factor that
/// serves as a preconditioner as long as few contacts have changed.
struct ResponseMemory {
  std::unique_ptr<SymmetricFactor> factor;
  std::vector<int> unknown;     ///< of K, for each row of the factor
  Eigen::VectorXd length;       ///< of each row: unknown of K = length * value there
  Eigen::MatrixXd fluctuation;  ///< of the last network
};

/// By conjugate gradients from the solution that `memory` holds, with its factor as preconditioner, to the
/// tolerance of the options by an estimate of the error. The first network, one with other grains, and one on
/// which this takes long are factorized, and the factor is kept.
template <int Dim>
[[nodiscard]] ElasticResponse elastic_response(const ContactNetwork<Dim>& network,
                                               const ResponseOptions& options, ResponseMemory& memory);

}  // namespace floc
