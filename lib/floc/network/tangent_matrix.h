#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_blocks.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Derivatives of the forces of a contact, rows and columns in the order of `ContactRows`; not symmetric where
/// one force depends on another. See contact_tangents().
template <int Dim>
using ConsistentStiffness = Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>>;

/// Action of the unknowns of the boundary (strains of the cell, displacements of walls) on one contact.
template <int Dim>
struct BoundaryColumns {
  static constexpr int kMaxColumns = 2 * kSymmetric<Dim>;
  /// Displacement of j against i for a unit of each unknown: Dim rows, one column per unknown.
  Eigen::Matrix<double, Dim, Eigen::Dynamic, 0, Dim, kMaxColumns> displacement;
  /// Derivative of displacement^T (force on i) by the displacement of j against i, with the force held fixed:
  /// one row per unknown, Dim columns. Zero for a wall; the force itself where a strain displaces along it by a
  /// component of the branch.
  Eigen::Matrix<double, Eigen::Dynamic, Dim, 0, kMaxColumns, Dim> follow;
};

/// Derivative of the forces on grains and boundary by their unknowns, the sum of G^T D G over contacts and of
/// all geometric terms, including those of tangential forces and rolling moments: the tangent of a Newton
/// iteration. Not symmetric.
///
/// Unknowns: translations and rotations (times the grain's size) of each grain, then those of the boundary.
/// Loads correspond: force, and moment over the grain's size. The sign is that of a stiffness: minus the
/// derivative of the force on what moves. The pattern is that of the pairs it was made for; values are added
/// contact by contact.
template <int Dim>
class TangentMatrix {
 public:
  /// @param graph  contact_graph() of the contacts that may be added
  TangentMatrix(std::vector<double> grain_size, const ContactGraph& graph, int n_boundary);

  /// Sets the matrix to zero, with `regularisation` on the diagonal.
  void reset(double regularisation);

  /// Adds a contact of two round grains: its arms lie along the branch, in constant shares of it, and its
  /// history turns with the branch and, about it, with the mean rotation of the two grains.
  void add(const NetworkContact<Dim>& contact, const ConsistentStiffness<Dim>& d,
           const BoundaryColumns<Dim>& boundary);

  /// Adds to the block of the boundary.
  void add_boundary(const Eigen::Ref<const Eigen::MatrixXd>& block);

  /// Returns the matrix, of order kDofs * grains + boundary unknowns, compressed.
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  class Sum;
  void lay_out(const ContactGraph& graph);

  std::vector<double> grain_size_;
  int n_boundary_;
  std::vector<int> start_;      // of each grain in `neighbour_`, and the end
  std::vector<int> neighbour_;  // of each grain, itself among them, ascending
  Eigen::SparseMatrix<double> matrix_;
};

}  // namespace floc
