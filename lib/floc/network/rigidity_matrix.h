#pragma once

#include <Eigen/SparseCore>

#include "floc/network/contact_network.h"

namespace floc {

/// Set of the strains of the cell that are unknowns.
enum class StrainSet {
  diagonal,  ///< eps_11, eps_22 (, eps_33); shear strains clamped
  full,      ///< then gamma_12 (2D), or gamma_23, gamma_13, gamma_12 (3D); gamma = 2 eps
};

template <int Dim>
constexpr int n_strains(StrainSet set) {
  return set == StrainSet::diagonal ? Dim : kSymmetric<Dim>;
}

/// Returns the strain tensor of one unit of a strain unknown, in the order of `StrainSet`. Shortening positive.
template <int Dim>
Mat<Dim> unit_strain(int column);

/// Relative motion of one contact, linear in the unknowns. Rows: overlap; tangential displacement of j against
/// i along each tangent; rotation of j against i, in 3D about the normal (twisting), then about each tangent
/// (rolling). Row by row they are conjugate to normal force, tangential force on i and moment on i: forces f
/// balance loads G^T f.
template <int Dim>
struct ContactRows {
  Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>> on_i;  ///< unknowns of i; those of j are added if i = j
  Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>> on_j;  ///< unknowns of j; zero if i = j
  Eigen::Matrix<double, kDofs<Dim>, kSymmetric<Dim>> on_strain;  ///< strains in the order of StrainSet::full
};

/// One stiffness for each row of `ContactRows`.
template <int Dim>
using RowStiffness = Eigen::Matrix<double, kDofs<Dim>, 1>;

/// Returns the rows of a contact.
template <int Dim>
ContactRows<Dim> contact_rows(const NetworkContact<Dim>& contact);

/// Returns the rows of a contact on the displacement that the two walls of each axis share, one column per
/// axis. They are zero except for the overlap with a wall of that axis, since walls move along their normal
/// alone.
template <int Dim>
Eigen::Matrix<double, kDofs<Dim>, Dim> rows_on_walls(const NetworkContact<Dim>& contact);

/// Returns the number of unknowns of the boundary: the strains and, for each axis between walls, the common
/// displacement of its two walls over wall_shift_unit().
template <int Dim>
int n_boundary_unknowns(const ContactNetwork<Dim>& network, StrainSet strains);

/// Returns the side of a cube (square) as large as the network (length). A displacement divided by it is like a
/// strain.
template <int Dim>
double wall_shift_unit(const ContactNetwork<Dim>& network);

/// The rows of a contact on the unknowns of the boundary.
template <int Dim>
using BoundaryRows =
    Eigen::Matrix<double, kDofs<Dim>, Eigen::Dynamic, Eigen::ColMajor, kDofs<Dim>, kSymmetric<Dim> + Dim>;

/// Returns the rows of a contact on the unknowns of the boundary. @param rows  contact_rows() of the contact
template <int Dim>
BoundaryRows<Dim> boundary_rows(const ContactNetwork<Dim>& network, const NetworkContact<Dim>& contact,
                                const ContactRows<Dim>& rows, StrainSet strains);

/// Returns the axes of the rotations of `ContactRows`, as columns in the coordinates of space.
inline Mat<1> rotation_axes(const Mat<2>&) {
  return Mat<1>::Identity();
}
inline Mat<3> rotation_axes(const Mat<3>& frame) {
  return frame;
}

/// Returns the normal, tangential, twisting and rolling stiffnesses of a contact, in the order of
/// `ContactRows`.
template <int Dim>
RowStiffness<Dim> row_stiffness(const NetworkContact<Dim>& contact);

/// Returns the rows on which the force carried by a contact acts: relative translation alone, without
/// rotations.
template <int Dim>
ContactRows<Dim> translation_rows(ContactRows<Dim> rows);

/// Returns the geometric stiffness of translation_rows(): -F_N/r along the tangents, and zero at a wall, whose
/// normal does not turn (force/length).
template <int Dim>
RowStiffness<Dim> row_prestress(const NetworkContact<Dim>& contact);

/// Returns the rigidity matrix G: kDofs rows per contact (order of `ContactRows`) x [kDofs columns per grain,
/// then the strains]. Without prestress K = G^T k G.
template <int Dim>
Eigen::SparseMatrix<double> rigidity_matrix(const ContactNetwork<Dim>& network, StrainSet strains);

/// Returns sqrt(k) G, whose square is K. It loses only half the digits that K loses to soft modes.
/// @pre no stiffness is negative (a distant attraction's has no square root).
template <int Dim>
Eigen::SparseMatrix<double> scaled_rigidity_matrix(const ContactNetwork<Dim>& network, StrainSet strains);

}  // namespace floc
