#pragma once

#include <Eigen/SparseCore>

#include "floc/network/contact_network.h"
#include "floc/network/rigidity_matrix.h"

namespace floc {

struct StiffnessOptions {
  StrainSet strains = StrainSet::diagonal;
  /// Whether the geometric stiffness of each contact is added. For round grains it is -(F_N/r)(1 - n n), with the
  /// normal force F_N, the distance r between the centres and the normal n. The geometric terms of tangential forces
  /// are left out, so the matrix is the exact derivative of the forces only if all tangential forces are zero. For
  /// grains with corners, the geometric stiffness includes all forces (geometric_springs()).
  bool prestress = false;
  /// Whether unknowns of the boundary are added after the strains. For each axis between walls, this unknown is the
  /// common displacement of the two walls divided by wall_shift_unit().
  bool wall_shifts = false;
  /// Whether the geometric stiffness due to tangential forces and moments is added for contacts of round grains (the
  /// symmetric part). For grains with corners, `prestress` adds this part. If `prestress` is also set, the quadratic
  /// form of the matrix is the second-order work of all forces and moments.
  bool shear_prestress = false;
};

/// Stiffness matrix K of a network in blocks: [grains, border; border^T, boundary]. The unknowns U are the translations
/// and rotations of each grain relative to the affine motion, then the unknowns of the boundary: strains of the cell
/// and, if StiffnessOptions::wall_shifts is set, displacements of walls. K U is the vector of loads: forces and moments
/// on the grains, and volume times stress for the strains.
struct StiffnessMatrix {
  Eigen::SparseMatrix<double> grains;  ///< block of the grains, lower triangle, of order kDofs * n_grains
  /// block that couples grains and boundary: rows as in `grains`, one column per boundary unknown
  Eigen::MatrixXd border;
  Eigen::MatrixXd boundary;  ///< block of the boundary unknowns, with both triangles

  /// Returns the whole matrix K, both triangles, for inspection.
  Eigen::SparseMatrix<double> whole() const;
};

/// Assembles the stiffness matrix K in compressed columns. The matrix contains a full block for each pair of grains in
/// contact, including zeros. The pattern of the matrix therefore does not depend on the stiffnesses.
template <int Dim>
StiffnessMatrix stiffness_matrix(const ContactNetwork<Dim>& network, const StiffnessOptions& options);

/// Returns the affine moduli (Voigt's estimate) times the volume: the moduli that the network would have if every grain
/// moved with the strain and did not rotate.
template <int Dim>
Eigen::MatrixXd affine_stiffness(const ContactNetwork<Dim>& network, StrainSet strains);

}  // namespace floc
