#pragma once

#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "floc/linalg/symmetric_factor.h"
#include "floc/rigid/separating_planes.h"

namespace floc {

/// Step of the unknowns of a packing and of its separating planes.
struct PlaneStep {
  Eigen::VectorXd motion;        ///< step of the unknowns of the packing (PlaneUnknowns)
  std::vector<PlaneVector> own;  ///< for each plane, the step of the unknowns of its pair and of the plane
  /// product of the step and the load, which is the decrease of the objective to first order
  double decrement = 0.0;
  /// Whether the matrix is positive definite without a shift of its diagonal.
  bool is_convex = false;
};

/// Newton's equations for a minimum of f - mu sum log g, with an objective f and a sum over the gaps g of all vertices
/// to the separating planes. Each plane couples only to its pair of bodies, so the unknowns of the planes are
/// eliminated pair by pair. The remaining matrix has the sparsity pattern of a stiffness matrix.
class PlaneEquations {
 public:
  PlaneEquations(const PlaneUnknowns& unknowns, int n_grains) : n_(unknowns.n), n_grains_(n_grains) {}

  /// Sets the pattern of the matrix; required after each change of the list of planes.
  void set_pattern(const std::vector<SeparatingPlane>& planes);

  /// Sets the matrix and the load to zero.
  void reset();
  /// Adds a value to an element of the matrix, row >= column, and an element of the load.
  void add(int row, int column, double value) { matrix_.coeffRef(row, column) += value; }
  void add_load(int row, double value) { load_[row] += value; }
  /// Adds the terms of all planes, see add_gaps().
  void add(const std::vector<SeparatingPlane>& planes, const GrainVertices& vertices, const GapTerms& terms);

  /// Solves the equations. The diagonal of the scaled matrix is shifted until the matrix is positive definite. Returns
  /// no value if no shift is large enough.
  std::optional<PlaneStep> solve(const std::vector<SeparatingPlane>& planes);

 private:
  using PlaneBlock = Eigen::Matrix<double, kPlaneUnknowns, kPlaneUnknowns>;
  /// Equations of the unknowns of one plane.
  struct Eliminated {
    PlaneBlock inverse = PlaneBlock::Zero();
    Eigen::Matrix<double, kPairUnknowns, kPlaneUnknowns> coupling;
    Vec<3> load = Vec<3>::Zero();
  };

  static PlaneBlock positive_inverse(const PlaneBlock& block);
  bool factorize(const Eigen::VectorXd& scale, double& shift);

  int n_, n_grains_;
  Eigen::SparseMatrix<double> matrix_;  ///< lower triangle
  Eigen::VectorXd load_;
  std::vector<int> group_;  ///< number of the grain of each row
  std::vector<Eliminated> eliminated_;
  SymmetricFactor factor_;
  double last_shift_ = 0.0;  ///< last successful shift above the smallest shift
};

}  // namespace floc
