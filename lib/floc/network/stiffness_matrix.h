#pragma once

#include <Eigen/SparseCore>

#include "floc/network/contact_network.h"

namespace floc {

/// Which strains of the cell are unknowns.
enum class StrainSet {
  diagonal,  ///< eps_11, eps_22 (, eps_33); shear strains clamped
  full,      ///< then gamma_12 (2D), or gamma_23, gamma_13, gamma_12 (3D); gamma = 2 eps
};

template <int Dim>
constexpr int n_strains(StrainSet set) {
  return set == StrainSet::diagonal ? Dim : kSymmetric<Dim>;
}

/// Strain tensor of one unit of a strain unknown, in the order of `StrainSet`. Shortening positive.
template <int Dim>
Mat<Dim> unit_strain(int column);

/// Relative motion of one contact, linear in the unknowns. Rows: overlap; tangential displacement of j against
/// i along each tangent; rotation of j against i. Row by row they do work on normal force, tangential force on
/// i and rolling moment on i: forces f are in balance with loads G^T f.
template <int Dim>
struct ContactRows {
  Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>> on_i;  ///< unknowns of i; those of j are added if i = j
  Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>> on_j;  ///< unknowns of j; zero if i = j
  Eigen::Matrix<double, kDofs<Dim>, kSymmetric<Dim>> on_strain;  ///< strains in the order of StrainSet::full
};

template <int Dim>
ContactRows<Dim> contact_rows(const NetworkContact<Dim>& contact);

/// Normal, tangential and rolling stiffness of the rows of `ContactRows`.
template <int Dim>
Eigen::Matrix<double, kDofs<Dim>, 1> row_stiffness(const NetworkContact<Dim>& contact);

/// Rigidity matrix G: kDofs rows a contact (order of `ContactRows`) x [kDofs columns a grain, then the
/// strains]. K = G^T k G without prestress.
template <int Dim>
Eigen::SparseMatrix<double> rigidity_matrix(const ContactNetwork<Dim>& network, StrainSet strains);

struct StiffnessOptions {
  StrainSet strains = StrainSet::diagonal;
  /// Adds the geometric terms -(F_N/r)(1 - n n) on the relative translation. Terms in F_T are left out: the
  /// matrix is the exact derivative of the forces where F_T = 0.
  bool prestress = false;
};

/// Stiffness matrix K of a network in blocks: [grains, border; border^T, boundary]. Unknowns are the
/// translations and rotations of each grain's fluctuation about the affine motion, then the boundary's
/// unknowns, here strains of the cell (any other boundary is another set of columns). K U is the load: force
/// and moment on the grains, volume times stress on the strains.
struct StiffnessMatrix {
  Eigen::SparseMatrix<double> grains;  ///< lower triangle, order kDofs * n_grains
  Eigen::MatrixXd border;              ///< rows as `grains`, one column a boundary unknown
  Eigen::MatrixXd boundary;            ///< square, both triangles

  /// Both triangles of the whole matrix, for inspection.
  Eigen::SparseMatrix<double> whole() const;
};

template <int Dim>
StiffnessMatrix stiffness_matrix(const ContactNetwork<Dim>& network, const StiffnessOptions& options);

/// The block of the strains alone: volume times the moduli if every grain followed the strain without turning
/// (Voigt).
template <int Dim>
Eigen::MatrixXd affine_stiffness(const ContactNetwork<Dim>& network, StrainSet strains);

}  // namespace floc
