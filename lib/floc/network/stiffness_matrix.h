#pragma once

#include <Eigen/SparseCore>

#include "floc/network/contact_network.h"
#include "floc/network/rigidity_matrix.h"

namespace floc {

struct StiffnessOptions {
  StrainSet strains = StrainSet::diagonal;
  /// Adds the geometric terms -(F_N/r)(1 - n n) for the relative translation. Terms in F_T are left out, so that the
  /// matrix is the exact derivative of the forces only if F_T = 0.
  bool prestress = false;
  /// Adds unknowns after the strains: the common displacement of the two walls of each axis, divided by
  /// wall_shift_unit().
  bool wall_shifts = false;
  /// Adds the symmetric part of the geometric terms in F_T and in the moments of contacts. With `prestress`, the
  /// quadratic form of the matrix is then the second-order work of all forces.
  bool shear_prestress = false;
};

/// Stiffness matrix K of a network in blocks: [grains, border; border^T, boundary]. The unknowns U are the translations
/// and rotations of each grain relative to the affine motion, then the unknowns of the boundary (strains of the cell
/// and, if chosen, displacements of walls). K U is the load: forces and moments on the grains, volume times stress for
/// the strains.
struct StiffnessMatrix {
  Eigen::SparseMatrix<double> grains;  ///< lower triangle of the block of the grains, of order kDofs * n_grains
  Eigen::MatrixXd
      border;  ///< coupling of grains and boundary: rows as in `grains`, one column per boundary unknown
  Eigen::MatrixXd boundary;  ///< block of the boundary unknowns, both triangles

  /// Returns both triangles of the whole matrix, for inspection.
  Eigen::SparseMatrix<double> whole() const;
};

/// Assembles the stiffness matrix K in compressed columns. The sparsity pattern follows from the contact graph: a full
/// block for each pair of grains in contact, zeros included, so that the pattern does not depend on the stiffnesses.
template <int Dim>
StiffnessMatrix stiffness_matrix(const ContactNetwork<Dim>& network, const StiffnessOptions& options);

/// Returns the block of K for the strains: volume times the moduli that the network would have if every grain followed
/// the strain without rotating (Voigt).
template <int Dim>
Eigen::MatrixXd affine_stiffness(const ContactNetwork<Dim>& network, StrainSet strains);

}  // namespace floc
