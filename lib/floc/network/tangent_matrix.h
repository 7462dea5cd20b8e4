#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_blocks.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Derivatives of the forces and moments of a contact with respect to the relative motion at the contact, with rows and
/// columns in the order of `ContactRows`, see contact_tangents(). Not symmetric if, for example, friction makes one
/// force depend on another.
template <int Dim>
using ConsistentStiffness = Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>>;

/// Effect of the unknowns of the boundary (strains of the cell, displacements of walls) on one contact between i and j.
template <int Dim>
struct BoundaryColumns {
  static constexpr int kMaxColumns = 2 * kSymmetric<Dim>;
  /// Displacement of j relative to i if a boundary unknown is 1: Dim rows, one column per boundary unknown.
  Eigen::Matrix<double, Dim, Eigen::Dynamic, 0, Dim, kMaxColumns> displacement;
  /// Derivative of displacement^T (force on i) with respect to the displacement of j relative to i, while the force is
  /// fixed: one row per boundary unknown, Dim columns. For a displacement of a wall it is zero. For a strain it is a
  /// component of the force, because `displacement` is proportional to a component of the branch.
  Eigen::Matrix<double, Eigen::Dynamic, Dim, 0, kMaxColumns, Dim> follow;
};

/// Tangent matrix of a Newton iteration: minus the derivative of the forces on grains and boundary with respect to the
/// unknowns of grains and boundary, so that its sign is that of a stiffness. It is the sum, over contacts, of G^T D G
/// (motion G at the contact per unknown, stiffness D of the contact) and of all geometric terms, including those of
/// tangential forces and rolling moments. Not symmetric.
///
/// The unknowns are the translations and rotations (times the grain's size) of each grain, then the unknowns of the
/// boundary. The loads are the forces and moments (over the grain's size) on the grains, then those on the boundary.
/// The pattern of the matrix is fixed by the pairs of grains given to the constructor; values are added contact by
/// contact.
template <int Dim>
class TangentMatrix {
 public:
  /// @param grain_size  size of each grain (length)
  /// @param graph       contact_graph() of the contacts that may be added
  /// @param n_boundary  number of unknowns of the boundary
  TangentMatrix(std::vector<double> grain_size, const ContactGraph& graph, int n_boundary);

  /// Sets the matrix to `regularisation` on the diagonal and zero elsewhere.
  void reset(double regularisation);

  /// Adds a contact of two round grains. The lever arms lie along the branch and are constant shares of it. The
  /// tangential spring turns with the branch, and about the branch with the mean rotation of the two grains.
  /// @param d         derivatives of the contact's forces with respect to its relative motion
  /// @param boundary  effect of the boundary's unknowns on the contact
  void add(const NetworkContact<Dim>& contact, const ConsistentStiffness<Dim>& d,
           const BoundaryColumns<Dim>& boundary);

  /// Adds a matrix to the block of the boundary unknowns.
  void add_boundary(const Eigen::Ref<const Eigen::MatrixXd>& block);

  /// Returns the matrix, of order kDofs * grains + boundary unknowns, in compressed columns.
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  class Sum;
  void lay_out(const ContactGraph& graph);

  std::vector<double> grain_size_;
  int n_boundary_;
  // for each grain, the index of its first neighbour in `neighbour_`; then the size of `neighbour_`
  std::vector<int> start_;
  std::vector<int> neighbour_;  // neighbours of each grain, including itself, ascending
  Eigen::SparseMatrix<double> matrix_;
};

}  // namespace floc
