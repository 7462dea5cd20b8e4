#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_blocks.h"
#include "floc/network/contact_network.h"
#include "floc/network/geometric_stiffness.h"

namespace floc {

/// Derivatives of the forces and moments of a contact with respect to the components of the relative motion at the
/// contact, from contact_tangents(). Rows and columns are in the order of the rows of `ContactRows`. The matrix is not
/// symmetric if, for example, friction makes the tangential force depend on the normal force.
template <int Dim>
using ConsistentStiffness = Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>>;

/// Effect of the unknowns of the boundary (strains of the cell, displacements of walls) on one contact between i and j.
template <int Dim>
struct BoundaryColumns {
  static constexpr int kMaxColumns = 2 * kSymmetric<Dim>;
  /// Displacement of j relative to i if a boundary unknown is 1: Dim rows, one column per boundary unknown.
  Eigen::Matrix<double, Dim, Eigen::Dynamic, 0, Dim, kMaxColumns> displacement;
  /// Change of the load on each boundary unknown (rows) if j is displaced by 1 relative to i along an axis (columns)
  /// and the force of the contact is constant. For a strain, the change is a component of the force, because the load
  /// on a strain is proportional to the vector from i to j. For a displacement of a wall, the change is zero.
  Eigen::Matrix<double, Eigen::Dynamic, Dim, 0, kMaxColumns, Dim> follow;
};

/// Tangent matrix of a Newton iteration, with the sign of a stiffness: minus the derivative of the forces on grains and
/// boundary with respect to the unknowns of grains and boundary. The matrix is not symmetric. For each contact it
/// contains G^T D G, where G times the unknowns is the motion at the contact, and D is the stiffness of the contact.
/// The matrix also contains all geometric terms, including those of tangential forces and rolling moments.
///
/// The unknowns are the translations and rotations of each grain, then the unknowns of the boundary. The loads are the
/// forces and moments on each grain, then the loads on the boundary. Rotations are multiplied by the size of the grain,
/// and moments are divided by it. The pairs of grains that are passed to the constructor determine the pattern of the
/// matrix; values are added contact by contact.
template <int Dim>
class TangentMatrix {
 public:
  /// @param grain_size  size of each grain (length)
  /// @param graph       contact_graph() of the contacts that may be added
  /// @param n_boundary  number of unknowns of the boundary
  TangentMatrix(std::vector<double> grain_size, const ContactGraph& graph, int n_boundary);

  /// Sets the matrix to `regularisation` on the diagonal and zero elsewhere.
  void reset(double regularisation);

  /// Adds a contact of two round grains. The lever arms are constant shares of the vector between the centres of the
  /// grains. The tangential spring rotates together with this vector. In addition, it rotates about this vector by the
  /// mean rotation of the two grains.
  /// @param d         derivatives of the forces of the contact with respect to the relative motion at the contact
  /// @param boundary  effect of the unknowns of the boundary on the contact
  void add(const NetworkContact<Dim>& contact, const ConsistentStiffness<Dim>& d,
           const BoundaryColumns<Dim>& boundary) {
    add(contact, d, geometric_stiffness(contact), boundary);
  }

  /// Adds a contact with a given geometric stiffness, which has the form of geometric_stiffness().
  void add(const NetworkContact<Dim>& contact, const ConsistentStiffness<Dim>& d,
           const MotionMatrix<Dim>& geometric, const BoundaryColumns<Dim>& boundary);

  /// Adds a matrix to the block of the boundary unknowns.
  void add_boundary(const Eigen::Ref<const Eigen::MatrixXd>& block);

  /// Returns the matrix, of order kDofs * grains + boundary unknowns, in compressed columns.
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  class Sum;
  void lay_out(const ContactGraph& graph);

  std::vector<double> grain_size_;
  int n_boundary_;
  // for each grain, the index of its first neighbour in `neighbour_`; one additional last entry is the size of
  // `neighbour_`
  std::vector<int> start_;
  std::vector<int> neighbour_;  // neighbours of each grain, including itself, ascending
  Eigen::SparseMatrix<double> matrix_;
};

}  // namespace floc
