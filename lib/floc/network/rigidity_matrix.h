#pragma once

#include <Eigen/SparseCore>

#include "floc/network/contact_network.h"

namespace floc {

/// Set of strains of the cell that are unknowns of the elastic response.
enum class StrainSet {
  diagonal,  ///< eps_11, eps_22 (and eps_33); shear strains are fixed at zero
  full,      ///< diagonal strains, then gamma_12 (2D) or gamma_23, gamma_13, gamma_12 (3D); gamma = 2 eps
};

template <int Dim>
constexpr int n_strains(StrainSet set) {
  return set == StrainSet::diagonal ? Dim : kSymmetric<Dim>;
}

/// Returns the strain tensor for which one strain unknown is 1 and all other strain unknowns are 0; shortening is
/// positive.
/// @param column  number of this strain unknown in the order of StrainSet
template <int Dim>
Mat<Dim> unit_strain(int column);

/// Matrix G that gives the relative motion at one contact as a linear function of the unknowns. The rows of G are the
/// components of this motion: the overlap; the tangential displacement of j relative to i along each tangent; the
/// rotation of j relative to i, in 3D about the normal (twisting), then about each tangent (rolling). Let f be the
/// vector of the normal force, the tangential force on i and the moments on i. The contact balances the loads G^T f on
/// the unknowns.
template <int Dim>
struct ContactRows {
  /// columns for the unknowns of i; if i = j, they also contain the columns for the unknowns of j
  Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>> on_i;
  Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>> on_j;  ///< columns for the unknowns of j; zero if i = j
  /// columns for the strains, in the order of StrainSet::full
  Eigen::Matrix<double, kDofs<Dim>, kSymmetric<Dim>> on_strain;
  /// Columns for the displacement of the touched wall along each axis; zero for a contact between grains. A wall moves
  /// only along its normal, so that at most one column is not zero.
  Eigen::Matrix<double, kDofs<Dim>, Dim> on_wall;
};

/// Stiffness for each component of the relative motion at a contact, in the order of the rows of `ContactRows`.
template <int Dim>
using RowStiffness = Eigen::Matrix<double, kDofs<Dim>, 1>;

/// Returns the matrix G of one contact (see ContactRows).
template <int Dim>
ContactRows<Dim> contact_rows(const NetworkContact<Dim>& contact);

/// Returns the derivatives of the overlap of a contact with respect to the rotation angles of one of its grains about
/// the axes (length). For round grains they are zero up to rounding.
template <int Dim>
RotationVector<Dim> normal_moment(const NetworkContact<Dim>& contact, int grain);

/// Returns the number of unknowns of the boundary: the strains and, for each axis between walls, the common
/// displacement of its two walls divided by wall_shift_unit().
template <int Dim>
int n_boundary_unknowns(const ContactNetwork<Dim>& network, StrainSet strains);

/// Returns the unit of displacements of walls (length): the side of a cube (square in 2D) with the volume of the
/// network. In this unit, displacements are comparable to strains.
template <int Dim>
double wall_shift_unit(const ContactNetwork<Dim>& network);

/// Matrix with one column per unknown of the boundary: the relative motion at a contact (rows as in ContactRows) if
/// this unknown is 1.
template <int Dim>
using BoundaryRows =
    Eigen::Matrix<double, kDofs<Dim>, Eigen::Dynamic, Eigen::ColMajor, kDofs<Dim>, kSymmetric<Dim> + Dim>;

/// Returns a matrix with one column per unknown of the boundary: the relative motion at a contact if this unknown is 1.
template <int Dim>
BoundaryRows<Dim> boundary_rows(const ContactNetwork<Dim>& network, const ContactRows<Dim>& rows,
                                StrainSet strains);

/// Returns the axes of the relative rotations in `ContactRows` for a contact with the given frame. Each column is the
/// axis of one component.
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

/// Returns the relative motion at a contact without the effect of rotations: the displacement of the centre of j
/// relative to the centre of i.
/// @param rows  contact_rows() of the contact
template <int Dim>
ContactRows<Dim> translation_rows(ContactRows<Dim> rows);

/// Returns the geometric stiffness (force/length) due to the normal force F_N, in the order of the rows of
/// translation_rows(). Along the tangents, the stiffness is -F_N/r, where r is the distance between the centres of the
/// two grains. At a wall the stiffness is zero, because the normal of a wall does not rotate.
template <int Dim>
RowStiffness<Dim> row_prestress(const NetworkContact<Dim>& contact);

/// Returns the rigidity matrix G of a network. G has kDofs rows per contact, in the order of `ContactRows`. It has a
/// column for each of the kDofs unknowns of every grain, then a column for each strain. Without prestress the stiffness
/// matrix is K = G^T k G, with the contact stiffnesses k.
template <int Dim>
Eigen::SparseMatrix<double> rigidity_matrix(const ContactNetwork<Dim>& network, StrainSet strains);

/// Returns R = sqrt(k) G for the contact stiffnesses k and the rigidity matrix G; R^T R is the stiffness matrix K. If a
/// soft mode is computed from R instead of K, only half as many digits are lost by rounding.
/// @pre no stiffness is negative (attractions across a gap have a negative stiffness)
template <int Dim>
Eigen::SparseMatrix<double> scaled_rigidity_matrix(const ContactNetwork<Dim>& network, StrainSet strains);

}  // namespace floc
