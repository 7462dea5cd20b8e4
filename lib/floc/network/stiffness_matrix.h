#pragma once

#include <Eigen/SparseCore>

#include "floc/network/contact_network.h"
#include "floc/network/rigidity_matrix.h"

namespace floc {

struct StiffnessOptions {
  StrainSet strains = StrainSet::diagonal;
  /// Adds the geometric terms -(F_N/r)(1 - n n) on the relative translation. Terms in F_T are left out, so that
  /// the matrix is the exact derivative of the forces only where F_T = 0.
  bool prestress = false;
  /// Adds, after the strains, the common displacement of the two walls of each axis over wall_shift_unit().
  bool wall_shifts = false;
  /// Adds, to the terms in F_N of `prestress`, the symmetric part of those in F_T and in the moments of
  /// contacts: the quadratic form of the matrix is then the second-order work of all forces.
  bool shear_prestress = false;
};

/// Stiffness matrix K of a network in blocks: [grains, border; border^T, boundary]. Unknowns are the
/// translations and rotations of each grain's fluctuation about the affine motion, then the boundary's
/// unknowns, here strains of the cell (any other boundary is another set of columns). K U is the load: force
/// and moment on the grains, volume times stress on the strains.
struct StiffnessMatrix {
  Eigen::SparseMatrix<double> grains;  ///< lower triangle, order kDofs * n_grains
  Eigen::MatrixXd border;              ///< rows as `grains`, one column per boundary unknown
  Eigen::MatrixXd boundary;            ///< square, both triangles

  /// Returns both triangles of the whole matrix, for inspection.
  Eigen::SparseMatrix<double> whole() const;
};

/// Assembles K in compressed columns whose places follow from the contact graph: a full block for each pair of
/// grains in contact, zeros included, so that the pattern does not depend on the stiffnesses.
template <int Dim>
StiffnessMatrix stiffness_matrix(const ContactNetwork<Dim>& network, const StiffnessOptions& options);

/// Returns the block of the strains alone: volume times the moduli that the network would have if every grain
/// followed the strain without turning (Voigt).
template <int Dim>
Eigen::MatrixXd affine_stiffness(const ContactNetwork<Dim>& network, StrainSet strains);

}  // namespace floc
