#pragma once

#include "floc/network/contact_network.h"

namespace floc {

/// Computes the geometric stiffness of a contact of round grains: the change of its forces and moments if the frame of
/// the contact rotates and the components of the forces and moments in this frame are constant.
///
/// Let r be the vector from the centre of grain i to the centre of grain j, n the normal, and dr the displacement of j
/// relative to i. The frame rotates by w = n x dn + psi n, with dn = (1 - n n) dr/|r| and psi = n.(rotation of i +
/// rotation of j)/2. The force on i is f = -F n + S, with the normal force F and the tangential force S. The moment on
/// i is share_i r x S + M, with the lever arm share_i r and the rolling and twisting moment M; the moment on j is
/// share_j r x S - M. Then
///
///   df = -F dn + w x S,  d(moment on i) = share_i (dr x S + r x (w x S)) + w x M
///
/// @return matrix with the sign of a stiffness; it has a column for each component of the motion, and a row for the
///         force or moment that does work on each component
template <int Dim>
MotionMatrix<Dim> geometric_stiffness(const NetworkContact<Dim>& contact);

/// Matrices whose products with the unknowns of two grains give the motion at the contact of the grains. The rows are
/// the components of the motion (kMotionRows), the columns are the unknowns.
template <int Dim>
struct GrainMotions {
  /// columns for the unknowns of i; for a contact of i with its own image they also contain the columns for the unknowns
  /// of j
  Eigen::Matrix<double, kMotionRows<Dim>, kDofs<Dim>> on_i;
  Eigen::Matrix<double, kMotionRows<Dim>, kDofs<Dim>>
      on_j;  ///< columns: unknowns of j; zero if i = j, and for walls
};

/// Returns the matrices of a contact (GrainMotions).
/// @param size_i, size_j  lengths by which rotations are multiplied to give the unknowns of i and of j; 1 if the
///                        unknowns are the rotations themselves
template <int Dim>
GrainMotions<Dim> grain_motions(const NetworkContact<Dim>& contact, double size_i, double size_j);

}  // namespace floc
